// The same points as rows, for who cannot or will not read a chart: the front alone, or all that is shown.

const columns = [
  {name: 'total_rms', title: 'Total RMS', unit: '%', text: (value) => percent(value)},
  {name: 'total_max', title: 'Total max', unit: '%', text: (value) => percent(value)},
  {name: 'spatial_rms', title: 'Spatial RMS', unit: '%', text: (value) => percent(value)},
  {name: 'fit_us', title: 'Fit', unit: 'µs'},
  {name: 'shade_ns_per_point', title: 'Shading', unit: 'ns a point'},
  ...(study.gpu ? [{name: 'gpu_ns_per_point', title: 'GPU', unit: 'ns a point'}] : []),
  {name: 'bytes', title: 'Bytes', text: (value) => count(value)},
  {name: 'sh_vectors', title: 'SH vectors', text: (value) => meanCount(value)},
  {name: 'near_lights', title: 'Near lights', text: (value) => meanCount(value)},
];

const kRows = 60;

function pointTable() {
  const body = element('tbody');
  const view = makeStore({rows: 'front', sort: 'cost', descending: false, most: kRows});
  const rows = choice('Rows', [{value: 'front', label: 'The front'}, {value: 'all', label: 'All that is shown'}], (value) => view.set({rows: value, most: kRows}));
  const heads = columns.map((column) => {
    const button = element('button', {type: 'button', class: 'sort', on: {click: () => {
      const {sort, descending} = view.get();
      view.set({sort: column.name, descending: sort === column.name && !descending});
    }}}, element('span', {}, column.title), column.unit ? element('small', {}, column.unit) : null);
    return {column, node: element('th', {scope: 'col'}, button)};
  });
  const more = element('button', {type: 'button', class: 'quiet more', on: {click: () => view.set({most: Infinity})}});

  const fill = () => {
    const {rows: which, sort, descending, most} = view.get();
    const {points, front} = visible(settings.get());
    const key = sort === 'cost' ? ({x}) => x : ({point}) => point[sort] ?? Infinity;
    const sortedRows = [...(which === 'front' ? front : points)].sort((a, b) => (descending ? key(b) - key(a) : key(a) - key(b)));
    body.replaceChildren(...sortedRows.slice(0, most).map(({point, optimal}) => element('tr', {},
      element('th', {scope: 'row', class: 'name'}, element('button', {type: 'button', class: 'pick', title: 'Show in the chart', on: {click: () => {
        settings.set({chosen: point, hovered: null});
        document.querySelector('.pareto-plot').scrollIntoView({block: 'nearest'});
      }}}, swatch(familyColor(point.family)), element('code', {}, ...typedParts(point.arguments)), point.near_form === 'exact' ? null : ` (${point.near_form})`, point.storage === 'half' ? ' (16 bits)' : null),
      optimal && which === 'all' ? element('span', {class: 'mark', title: 'On the front'}, '★') : null),
      ...columns.map((column) => element('td', {}, point[column.name] === null ? '–' : (column.text ?? figure)(point[column.name]))))));
    rows.show(which);
    for (const {column, node} of heads) {
      if (column.name === sort) node.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
      else node.removeAttribute('aria-sort');
    }
    more.hidden = sortedRows.length <= most;
    more.textContent = `Show all ${count(sortedRows.length)} rows`;
    markRow(settings.get());
  };
  const markRow = ({chosen}) => [...body.rows].forEach((row) => row.classList.toggle('chosen', chosen !== null && row.querySelector('code').textContent === chosen.arguments));

  let shownFor = '';
  settings.watch((values) => {
    const {chosen, hovered, ...drawing} = values;
    const key = JSON.stringify(drawing);
    if (key === shownFor) return markRow(values);
    shownFor = key;
    fill();
  });
  view.watch(fill);
  return element('section', {class: 'card', id: 'table'}, element('div', {class: 'bar'}, element('h2', {}, 'As a table'), rows.node),
    element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': 'Points of the chart as a table'},
      element('table', {class: 'points'}, element('thead', {}, element('tr', {}, element('th', {scope: 'col', class: 'name'}, 'To type'), ...heads.map(({node}) => node))), body)), more);
}
