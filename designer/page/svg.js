// Elements of a picture.

const NS = 'http://www.w3.org/2000/svg';

export function svg(tag, attributes = {}, parent) {
  const element = document.createElementNS(NS, tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  parent?.append(element);
  return element;
}
