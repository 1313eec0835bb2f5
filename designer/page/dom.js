// Elements of the page, made once and then only written.

const NS = 'http://www.w3.org/2000/svg';

export const $ = (id) => document.getElementById(id);

export function element(tag, text, attributes = {}) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

/** A button that does something. */
export function button(text, act, attributes = {}) {
  const made = element('button', text, { type: 'button', ...attributes });
  made.onclick = act;
  return made;
}

/** An element of a picture. */
export function svg(tag, attributes = {}, parent) {
  const made = document.createElementNS(NS, tag);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent?.append(made);
  return made;
}

/** The lines of `parent`, as many as are asked for. */
export function rows(parent, count, make) {
  while (parent.children.length > count) parent.lastChild.remove();
  while (parent.children.length < count) parent.append(make());
  return parent.children;
}

export function write(element, text) {
  const node = element.firstChild ?? element.appendChild(document.createTextNode(''));
  if (node.data !== text) node.data = text;
}

/** Tells whether any of the things it is called with is another one than the last time. */
export function watch() {
  let last;
  return (...things) => {
    const isSame = last?.every((thing, i) => Object.is(thing, things[i]));
    last = things;
    return !isSame;
  };
}
