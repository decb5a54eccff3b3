// What is shown: axes, families, filters.

/** Buttons of which any number is pressed. Returns {node, show(values)}. */
function toggles(label, options, onToggle) {
  const buttons = options.map(({value, text, color}) => element('button', {type: 'button', on: {click: () => onToggle(value)}}, color ? swatch(color) : null, text));
  return {
    node: element('div', {class: 'choice', role: 'group', 'aria-label': label}, element('span', {class: 'choice-label', 'aria-hidden': 'true'}, label), element('div', {class: 'segments'}, ...buttons)),
    show: (values) => buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(values.includes(options[i].value)))),
  };
}

const without = (values, value) => (values.includes(value) ? values.filter((other) => other !== value) : [...values, value]);

function axisControls() {
  const error = choice('Error', errors, (value) => settings.set({error: value}));
  const cost = choice('Cost', costs, (value) => settings.set({cost: value}));
  const shaded = choice('Points a frame', [1000, 10000, 100000].map((value) => ({value, label: count(value)})), (value) => settings.set({shaded: value}));
  settings.watch((values) => {
    error.show(values.error);
    cost.show(values.cost);
    shaded.show(values.shaded);
    shaded.node.hidden = values.cost !== 'frame_us';
  });
  return element('div', {class: 'controls'}, error.node, cost.node, shaded.node);
}

/** Families as a legend: a click hides or shows one, a double click all others. */
function familyLegend() {
  const present = distinct((point) => point.family);
  const shown = [...families.filter((family) => present.includes(family)), ...present.filter((family) => !families.includes(family))];
  const buttons = shown.map((family) => element('button', {
    type: 'button', title: 'Click to hide or show, double-click for this one alone', on: {
      click: () => settings.set({hidden: without(settings.get().hidden, family)}),
      dblclick: () => settings.set({hidden: shown.filter((other) => other !== family)}),
    },
  }, swatch(familyColor(family)), family));
  const all = element('button', {type: 'button', class: 'all', on: {click: () => settings.set({hidden: []})}}, 'All');
  settings.watch(({hidden}) => {
    buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(!hidden.includes(shown[i]))));
    all.hidden = !hidden.length;
  });
  return element('div', {class: 'legend', role: 'group', 'aria-label': 'Families of rigs'}, ...buttons, all);
}

function filterControls() {
  const rows = filters.filter((filter) => filter.all.length > 1).map((filter) => {
    const row = toggles(filter.label, filter.all.map((value) => ({value, text: filter.text(value)})), (value) => {
      const left = without(settings.get()[filter.name], value);
      if (left.length) settings.set({[filter.name]: left});  // the last one stays: an empty chart says nothing
    });
    settings.watch((values) => row.show(values[filter.name]));
    return row.node;
  });
  return element('div', {class: 'controls filters'}, ...rows);
}

function objectChoice() {
  if (study.objects.length < 2) return null;
  const objects = choice('Object', study.objects.map((object, value) => ({value, label: object.name})), (value) => settings.set({object: value, chosen: null, hovered: null}));
  settings.watch(({object}) => objects.show(object));
  return objects.node;
}
