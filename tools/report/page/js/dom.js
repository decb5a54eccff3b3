// Making elements and writing numbers. Names come from files, so text only ever enters the page as text nodes.

/** An element: `attributes` become attributes, `on` holds listeners; strings among `children` become text. */
function element(tag, attributes = {}, ...children) {
  return fillIn(document.createElement(tag), attributes, children);
}

function svgElement(tag, attributes = {}, ...children) {
  return fillIn(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function fillIn(node, {on = {}, ...attributes}, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== null && value !== false) node.setAttribute(name, value === true ? '' : value);
  }
  for (const [type, listener] of Object.entries(on)) node.addEventListener(type, listener);
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** A row of buttons of which one is pressed. `options` are {value, label, title?, color?}; returns {node, show(value)}. */
function choice(label, options, onChoose) {
  const buttons = options.map((option) => element('button', {
    type: 'button', 'aria-pressed': 'false', title: option.title, on: {click: () => onChoose(option.value)},
  }, option.color ? swatch(option.color) : null, option.label));
  const node = element('div', {class: 'choice', role: 'group', 'aria-label': label},
    element('span', {class: 'choice-label', 'aria-hidden': 'true'}, label), element('div', {class: 'segments'}, ...buttons));
  const show = (value) => buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(options[i].value === value)));
  return {node, show};
}

function swatch(color) {
  const node = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  node.style.background = color;
  return node;
}

/** Copies `text()`, which stands in the <code> beside the button. */
function copyButton(text) {
  const button = element('button', {type: 'button', class: 'quiet copy'}, 'Copy');
  button.addEventListener('click', async () => {
    let copied = true;
    try {
      await navigator.clipboard.writeText(text());
    } catch {  // pages from disk may not: the text is marked, for the keyboard
      const range = document.createRange();
      range.selectNodeContents(button.parentElement.querySelector('code'));
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      copied = document.execCommand('copy');
    }
    button.textContent = copied ? 'Copied' : 'Marked: Ctrl+C';
    setTimeout(() => { button.textContent = 'Copy'; }, 1600);
  });
  return button;
}

/**
 * Values that several views share. `watch(listener, ...names)` calls its listener at once, and again whenever one of the values
 * named has changed (any value where none is named).
 */
function makeStore(values) {
  const listeners = [];
  return {
    get: () => values,
    set(change) {
      const before = values;
      values = {...values, ...change};
      for (const {listener, names} of listeners) {
        if (!names.length || names.some((name) => values[name] !== before[name])) listener(values);
      }
    },
    watch(listener, ...names) {
      listeners.push({listener, names});
      listener(values);
    },
  };
}

/** Three significant digits, never in exponent form between 0.001 and a million. */
function figure(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(2);
  if (size >= 100) return Math.round(value).toLocaleString('en-US');
  return value.toPrecision(3);
}

const percent = (relative) => figure(100 * relative) + '\u00a0%';
const count = (value) => value.toLocaleString('en-US');
const plural = (n, noun) => `${count(n)} ${noun}${n === 1 ? '' : 's'}`;
/** A whole number where all frames have the same. */
const meanCount = (value) => (Number.isInteger(value) ? count(value) : value.toFixed(1));
const seconds = (time) => `${time.toFixed(2)} s`;
