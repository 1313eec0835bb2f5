// Elements of the page.

export const $ = (id) => document.getElementById(id);

/** A place as a picture takes it, however far outside it is. */
export const atMost = (x) => Math.min(Math.max(x, -1e5), 1e5).toFixed(1);

export function write(element, text) {
  const node = element.firstChild ?? element.appendChild(document.createTextNode(''));
  if (node.data !== text) node.data = text;
}

/** To which of so many things in a row an arrow key leads from `at`; nothing for another key. */
export function arrowed(event, at, count) {
  const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: count - 1 }[event.key];
  if (to === undefined) return undefined;
  event.preventDefault();
  return (to + count) % count;
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
