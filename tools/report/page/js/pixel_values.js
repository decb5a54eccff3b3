// The numbers of the pixel pointed at, and where they come from.

/** What a pixel holds: irradiance by rig and truth and their difference, W/m², and that over the mean irradiance. */
function valueTable(object) {
  const rows = ['Rig', 'Truth', 'Difference', 'Relative'].map((name, i) => ({
    name: element('span', {}, name), cells: [0, 1, 2, 3].map(() => element('td', {}, '–')), unit: element('small', {}, i === 3 ? '% of mean' : 'W/m²'),
  }));
  const where = element('caption', {});
  const source = element('p', {class: 'hint'});
  const table = element('table', {}, where, element('thead', {}, element('tr', {}, element('td'), ...[['R', 'Red'], ['G', 'Green'], ['B', 'Blue'], ['Lum.', 'Luminance']].map(([name, title]) => element('th', {scope: 'col', title}, name)))),
    element('tbody', {}, ...rows.map(({name, cells, unit}) => element('tr', {}, element('th', {scope: 'row'}, name, ' ', unit), ...cells))));

  /** Five digits tell any two half floats apart. */
  const digits = (value, count = 5) => (value === 0 ? '0' : Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3 ? value.toExponential(count - 1) : value.toPrecision(count)).replace('-', '−');
  const signed = (value, text) => (value > 0 ? '+' : '') + text;

  function show(shown, point) {
    const blank = (text) => {
      rows.forEach(({cells}) => cells.forEach((cell) => { cell.textContent = '–'; }));
      where.textContent = text;
    };
    if (!shown) return;
    const {frame, rig, numbers, irradiance} = shown;
    const {width, height, object: pixels, truth} = numbers;
    rows[0].name.textContent = object.rigs[rig].spec;
    source.textContent = sourceOf(frame, rig);
    if (!point) return blank('Point at a picture to read its pixels.');
    const [x, y] = [Math.min(width - 1, Math.floor(point[0] * width)), Math.min(height - 1, Math.floor(point[1] * height))];
    const at = pixels.places[y * width + x];
    if (at < 0) return blank(`Pixel ${x}, ${y}: not on the object.`);
    where.textContent = `Pixel ${x}, ${y}`;
    for (let c = 0; c < 4; ++c) {
      const of = (planes) => (c < 3 ? planes[c][at] : luminanceAt(planes, at));
      const [own, exact] = [of(irradiance), of(truth)];
      const difference = own - exact;
      const relative = object.mean_irradiance > 0 ? difference / object.mean_irradiance : 0;
      [digits(own), digits(exact), signed(difference, digits(difference, 4)), signed(relative, digits(100 * relative, 4))].forEach((text, row) => {
        rows[row].cells[c].textContent = text;
      });
      [own, exact, difference, relative].forEach((value, row) => { rows[row].cells[c].dataset.value = value; });
    }
  }

  function sourceOf(frame, rig) {
    const [first, second] = [object.rigs[rig].spec, 'truth'].map((label) => object.pictures.find((picture) => picture.frame === frame.frame && picture.label === label)?.image_exr);
    if (frame.exact && first && second) return `Channels irradiance.R, .G and .B of ${first} and ${second}, exactly. Mean irradiance: ${figure(object.mean_irradiance)} W/m².`;
    return `A smaller picture with fewer digits (within 0.4 %)${object.pictures.length ? '; the full one is exact' : ''}. Mean irradiance: ${figure(object.mean_irradiance)} W/m².`;
  }
  return {node: element('div', {class: 'values'}, element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': `Values of a pixel of ${object.name}`}, table), source), show};
}
