// Elements without markup in strings: text from the table always becomes a text node.

/** Creates an element. `attributes`: null and false are left out, true is empty, `on...` listen. */
export function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** A select with its label. `options`: [value, text] pairs. */
export function select(label, options, value, onchange) {
  const list = el('select', {'aria-label': label, onchange: () => onchange(list.value)});
  fillSelect(list, options, value);
  return list;
}

/** Replaces the options of a select. */
export function fillSelect(list, options, value) {
  list.replaceChildren(...options.map(([key, text]) => el('option', {value: key}, text)));
  list.value = value;
}

/** A label with its control after it. */
export function labelled(text, control) {
  return el('label', {class: 'field'}, el('span', {}, text), control);
}
