// Tables that sort by any column, with the mouse or the keyboard.

/** Strings as people count ("lamp 2" before "lamp 10"), numbers by size, what is missing last. */
function compareValues(x, y) {
  if (x === null || y === null) return (x === null) - (y === null);
  return typeof x === 'string' ? x.localeCompare(y, 'en', {numeric: true}) : x - y;
}

/**
 * The heads of `columns` {key, title, unit?, hint?, get?, downFirst?, text?}, each a button where the column has values to sort by;
 * `draw` is called when the order has changed. Returns {heads, sorted(rows, otherwise)}.
 */
function sortableHeads(columns, draw) {
  let by = null;
  let down = false;
  const heads = columns.map((column, i) => element('th', {scope: 'col', 'aria-sort': column.get ? 'none' : null, title: column.hint, class: i === 0 ? 'name' : column.text || !column.get ? 'text' : null},
    column.get ? element('button', {type: 'button', class: 'sort', on: {click: () => {
      down = by === column ? !down : Boolean(column.downFirst);
      by = column;
      heads.forEach((head, at) => {
        if (columns[at].get) head.setAttribute('aria-sort', columns[at] !== by ? 'none' : down ? 'descending' : 'ascending');
      });
      draw();
    }}}, element('span', {}, column.title), column.unit ? element('small', {}, column.unit) : null) : column.title));
  return {
    heads,
    sorted(rows, otherwise = () => 0) {
      return [...rows].sort(by ? (a, b) => (down ? -1 : 1) * compareValues(by.get(a), by.get(b)) : otherwise);
    },
  };
}
