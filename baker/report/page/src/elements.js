// SPDX-License-Identifier: Apache-2.0
// Elements of the page. Text is always text: nothing of a report is read as HTML.

/** An element; attributes that are functions are listeners ("onclick"), null and false ones are left out. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === false) continue;
    if (typeof value === 'function') made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/** A part of the report with a heading. */
export function section(id, title, lead, ...children) {
  return element('section', { id, 'aria-labelledby': `${id}-title` },
    element('h2', { id: `${id}-title` }, title), element('p', { class: 'lead' }, lead), ...children);
}

/** A number with its unit and what it means. */
export function fact(label, value, meaning) {
  return element('div', { class: 'fact' }, element('dt', {}, label), element('dd', {}, value),
    element('dd', { class: 'meaning' }, meaning));
}

export function facts(...children) {
  return element('dl', { class: 'facts' }, ...children);
}

/** A table; `columns` are headings. Columns with a number in a row align to the right. */
export function table(caption, columns, rows) {
  const isNumber = (content) => typeof content === 'string' && /^[-+\u2212\d.]/.test(content);
  const kinds = columns.map((_, c) => (rows.some((row) => isNumber(row[c])) ? 'number' : null));
  const cell = (content, c) => element('td', { class: kinds[c] }, content);
  return element('div', { class: 'table' }, element('table', {},
    element('caption', {}, caption),
    element('thead', {}, element('tr', {}, ...columns.map((name, c) => element('th', { scope: 'col', class: kinds[c] }, name)))),
    element('tbody', {}, ...rows.map((row) => element('tr', {}, ...row.map(cell))))));
}

/** A choice of one among several, as buttons: [[value, label]]; `onChoice` gets the value. */
export function choice(name, label, options, chosen, onChoice) {
  const radios = options.map(([value, text]) => {
    const input = element('input', {
      type: 'radio', name, value, checked: value === chosen, onchange: () => onChoice(value),
    });
    return element('label', {}, input, element('span', {}, text));
  });
  return element('fieldset', { class: 'choice' }, element('legend', {}, label), ...radios);
}

export function toggle(id, label, isOn, onToggle) {
  const input = element('input', { type: 'checkbox', id, checked: isOn, onchange: () => onToggle(input.checked) });
  return element('label', { class: 'toggle' }, input, element('span', {}, label));
}

/** A slider; `describe` says what a value means, and `onValue` gets it. */
export function slider(id, label, { min, max, step, value }, describe, onValue) {
  const output = element('output', { for: id }, describe(value));
  const input = element('input', {
    type: 'range', id, min, max, step, value,
    oninput: () => {
      output.textContent = describe(input.valueAsNumber);
      onValue(input.valueAsNumber);
    },
  });
  return element('div', { class: 'slider' }, element('label', { for: id }, label), output, input);
}
