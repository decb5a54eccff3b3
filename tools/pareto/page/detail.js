// One point in full, with what to type for it.

/** The command that measures the point again, with pictures. */
const quoted = (text) => (/^[\w./:,@%+=-]*$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
const commandOf = (point) => [`rigel report ${quoted(study.scene)}`, study.clip && `--clip ${quoted(study.clip)}`, study.lights_from && `--lights ${quoted(study.lights_from)}`,
  point.arguments, '--out out'].filter(Boolean).join(' ');

/** An option stays with its value where the line breaks. */
const typedParts = (text) => text.split(/ (?=--)/).flatMap((part, i) => [i ? ' ' : '', element('span', {}, part)]);

const orDash = (value, unit) => (value === null ? '–' : `${figure(value)} ${unit}`);

function figuresOf(point, shaded) {
  return [
    ['Total RMS', `${percent(point.total_rms)} (± ${percent(point.frame_uncertainty * point.total_rms)})`], ['Total maximum', percent(point.total_max)],
    ['Spatial RMS', percent(point.spatial_rms)], ['Spatial maximum', percent(point.spatial_max)],
    ['Fit', orDash(point.fit_us, 'µs')], ['Shading, CPU', orDash(point.shade_ns_per_point, 'ns a point')],
    [`Frame, ${count(shaded)} points`, orDash(frameTime(point, shaded), 'µs')],
    ...(study.gpu ? [['Shading, GPU', orDash(point.gpu_ns_per_point, 'ns a point')]] : []),
    ['Bytes', count(point.bytes)], ['SH vectors', meanCount(point.sh_vectors)], ['Near lights', meanCount(point.near_lights)], ['Projections a light', count(point.projections)],
  ];
}

function detail() {
  const title = element('h3', {});
  const code = element('code', {});
  const command = element('div', {class: 'command'}, code);
  command.append(copyButton(() => code.textContent));
  const list = element('dl', {class: 'figures-list'});
  const note = element('p', {class: 'hint'});
  settings.watch((values) => {
    const shown = visible(values);
    const point = values.hovered ?? values.chosen ?? knee(shown)?.point;
    if (!point) {
      title.textContent = 'No point is shown';
      command.hidden = true;
      list.replaceChildren();
      note.textContent = '';
      return;
    }
    const entry = shown.points.find((candidate) => candidate.point === point);
    title.replaceChildren(swatch(familyColor(point.family)), ` ${shortName(point)}`, ...(entry?.optimal ? [element('span', {class: 'badge'}, 'on the front')] : []));
    command.hidden = false;
    const typed = point.near_form === 'exact' ? commandOf(point) : point.arguments;
    code.replaceChildren(...typedParts(typed));
    list.replaceChildren(...figuresOf(point, values.shaded).map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, value))));
    note.textContent = point.near_form === 'exact' ? (point.storage === 'half' ? 'Shaders read the coefficients in 16 bits; the CPU does not.' : '')
      : `Near lights by ${point.near_form}Irradiance of near_light.h: a function for shaders of one’s own, which reports do not use.`;
  });
  return element('aside', {class: 'detail', 'aria-live': 'polite'}, title, command, list, note);
}

/** Shown until a point is chosen: the one on the front that is nearest to its lower left corner. */
function knee({front}) {
  const usable = front.filter(({x, y}) => x > 0 && y > 0);
  if (!usable.length) return front[0];
  const span = (get) => Math.log(Math.max(...usable.map(get)) / Math.min(...usable.map(get))) || 1;
  const part = (entry, get) => Math.log(get(entry) / Math.min(...usable.map(get))) / span(get);
  const distance = (entry) => part(entry, ({x}) => x) ** 2 + part(entry, ({y}) => y) ** 2;
  return usable.reduce((best, entry) => (distance(entry) < distance(best) ? entry : best));
}
