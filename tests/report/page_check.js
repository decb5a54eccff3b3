// Drives a report as a reader would, through its elements alone (page_driver.js). check_page.sh appends this to a report;
// the page itself knows nothing of it.
(() => {
  const data = JSON.parse(document.getElementById('report-data').textContent);
  const pictureData = JSON.parse(document.getElementById('picture-data').textContent);
  const all = (node, selector) => [...node.querySelectorAll(selector)];
  const pointer = (node, type, clientX) => node.dispatchEvent(new PointerEvent(type, {clientX, clientY: 0, button: 0, bubbles: true}));
  const button = (node, group, label) => all(node, `[aria-label="${group}"] button`).find((candidate) => candidate.textContent === label);

  function checkGallery(section, object) {
    const pictures = object.pictures.filter((picture) => picture.frame === object.pictures[0].frame);
    const frames = new Set(object.pictures.map((picture) => picture.frame));
    const stage = section.querySelector('.wipe .stage');
    const range = section.querySelector('.wipe input');
    const wipe = () => parseFloat(stage.style.getPropertyValue('--wipe'));

    range.value = 20;
    range.dispatchEvent(new Event('input'));
    equal(wipe(), 20, 'slider');
    press(range, 'ArrowRight');
    equal(wipe(), 22, 'arrow right');
    for (let i = 0; i < 20; ++i) press(range, 'ArrowLeft');
    equal(wipe(), 0, 'arrow left stops at the edge');
    const box = stage.getBoundingClientRect();
    pointer(stage, 'pointerdown', box.left + 0.25 * box.width);
    check(Math.abs(wipe() - 25) < 0.01, `press on the picture: ${wipe()}`);
    pointer(document, 'pointermove', box.right + 50);
    equal(wipe(), 100, 'drag beyond the picture');
    pointer(document, 'pointerup', box.right + 50);
    pointer(document, 'pointermove', box.left);
    equal(wipe(), 100, 'no drag after the release');

    equal(all(section, '.thumbnail').length, pictures.length, 'thumbnails');
    check(all(section, 'img').every((image) => image.src.startsWith('data:image/png;base64,')), 'a picture is not embedded');
    const rig = pictures[1];
    all(section, 'button.thumbnail')[0].click();
    equal(section.querySelector('.tag.left').textContent, rig.label, 'thumbnail chooses its rig');
    equal(button(section, 'Rig', rig.label).getAttribute('aria-pressed'), 'true', 'rig button follows');
    equal(section.querySelector('tr.chosen .pick')?.textContent, rig.label, 'table follows');
    equal(all(section, '[aria-label="Frame"] button').length, frames.size > 1 ? frames.size : 0, 'frame buttons');
    if (frames.size > 1) {
      all(section, '[aria-label="Frame"] button')[1].click();
      const second = object.pictures.findIndex((picture) => picture.frame !== object.pictures[0].frame);
      equal(all(section, '.stage img')[0].src, pictureData.objects[data.objects.indexOf(object)][second].image, 'truth of the second frame');
    }
    button(section, 'Show', 'Differences').click();
    equal(all(section, 'button.thumbnail img')[0].src, section.querySelector('.heat img').src, 'differences as thumbnails');
  }

  function checkTable(section, object) {
    const order = () => all(section, '.rigs .pick').map((pick) => pick.textContent).join('|');
    const sort = (title) => all(section, '.sort').find((candidate) => candidate.textContent.startsWith(title));
    const rigNamed = (spec) => object.rigs.find((rig) => rig.spec === spec);
    const rises = (sign) => order().split('|').map((spec) => sign * rigNamed(spec).total.rms).every((value, i, values) => !i || values[i - 1] <= value);
    equal(order(), object.rigs.map((rig) => rig.spec).join('|'), 'order of the command line');
    sort('Total RMS').click();
    check(rises(1), `sorted by total error: ${order()}`);
    equal(sort('Total RMS').closest('th').getAttribute('aria-sort'), 'ascending', 'aria-sort');
    sort('Total RMS').click();
    check(rises(-1), `sorted downwards: ${order()}`);
    const cost = data.objects.some(({rigs}) => rigs.some((rig) => rig.near_lights > 0)) ? 'modelled_ns_per_point' : 'bytes';
    const beaten = (rig) => object.rigs.some((other) => other !== rig && other[cost] <= rig[cost] && other.total.rms <= rig.total.rms &&
      (other[cost] < rig[cost] || other.total.rms < rig.total.rms));
    for (const row of all(section, '.rigs tbody tr')) {
      const rig = rigNamed(row.querySelector('.pick').textContent);
      equal(row.classList.contains('pareto'), !beaten(rig), `Pareto mark of ${rig.spec}`);
    }
    const pick = all(section, '.pick')[0];
    pick.focus();
    pick.click();
    check(document.activeElement === pick, 'choosing a rig loses the focus');
  }

  function checkTimeChart(section, object) {
    const place = section.querySelector('.plot[tabindex]');
    const lines = () => all(place, '.line');
    equal(lines().length, object.rigs.length, 'lines');
    const first = all(section, '.legend button')[0];
    first.click();
    equal(lines().length, object.rigs.length - 1, 'lines without the first rig');
    equal(first.getAttribute('aria-pressed'), 'false', 'legend');
    first.click();
    const shape = lines()[0].getAttribute('points');
    check(!/NaN|Infinity/.test(place.innerHTML), 'a coordinate of the chart is no number');
    button(section, 'Scale', 'Linear').click();
    check(lines()[0].getAttribute('points') !== shape, 'linear looks like logarithmic');
    button(section, 'Error', 'Spatial').click();
    check(place.textContent.includes('spatial RMS'), 'axis title follows the error');
    button(section, 'Error', 'Total').click();
    button(section, 'Scale', 'Log').click();
    press(place, 'End');
    const last = object.truth[object.truth.length - 1];
    check(place.querySelector('.readout').textContent.includes(`${last.time.toFixed(2)} s`), 'read-out at the last frame');
    press(place, 'Escape');
    check(place.querySelector('.readout').hidden, 'Escape hides the read-out');
    pointer(place, 'pointermove', place.getBoundingClientRect().left + 60);
    const chosen = object.rigs.find((rig) => rig.spec === section.querySelector('tr.chosen .pick')?.textContent);
    const chooses = (rig) => rig.frames.some((frame) => frame.near.length || frame.sh_vectors !== rig.frames[0].sh_vectors);
    const estimates = chosen?.frames.every((frame) => typeof frame.total_estimate === 'number');
    equal(all(place.querySelector('.readout'), '.entry').length, object.rigs.length + 2 + (estimates ? 1 : 0) + (chosen && chooses(chosen) ? 1 : 0), 'lines of the read-out');
    equal(all(place, '.estimate').length, estimates ? 1 : 0, 'estimate of the chosen rig');
    equal(all(place, '.vectors-line').length, object.rigs.filter(chooses).length, 'SH vectors of the rigs that choose');
    equal(all(place, '.near-line').length, object.rigs.filter(chooses).length, 'near lights of the rigs that choose');
    pointer(place, 'pointerleave', 0);
  }

  function checkCostChart(section, object) {
    const points = () => all(section, '.point');
    const at = (i) => points()[i].querySelector('.target').getAttribute('cx');
    const before = at(object.rigs.length - 1);
    const group = points()[0].closest('.card');
    button(group, 'Cost', 'Fit').click();
    check(at(object.rigs.length - 1) !== before, 'the cost axis does nothing');
    check(!/NaN|Infinity/.test(group.innerHTML), 'a coordinate of the cost chart is no number');
    press(points()[0], 'Enter');
    equal(section.querySelector('tr.chosen .pick').textContent, object.rigs[0].spec, 'a point chooses its rig');
    button(group, 'Cost', 'Modelled').click();
  }

  function checkLights(section, object) {
    const card = section.querySelector('.light-use').closest('.card');
    const rows = () => all(card, 'tbody tr');
    const names = () => rows().map((row) => row.querySelector('.name').textContent).join('|');
    const more = card.querySelector('.more');
    const sort = (title) => all(card, '.sort').find((candidate) => candidate.textContent.startsWith(title));
    const busiest = object.rigs.reduce((a, b) => (b.near_lights > a.near_lights ? b : a));
    if (object.rigs.length > 1) button(card, 'Rig', busiest.spec).click();
    equal(section.querySelector('tr.chosen .pick')?.textContent ?? busiest.spec, busiest.spec, 'the rig of the lights is chosen everywhere');
    const {lights} = busiest;
    equal(more.hidden, lights.length <= 20, 'button for all lights');
    equal(rows().length, Math.min(20, lights.length), 'first lights');
    if (!more.hidden) {
      more.click();
      equal(rows().length, lights.length, 'all lights');
    }
    const sorted = (get, sign) => [...lights].sort((a, b) => sign * (get(a) < get(b) ? -1 : get(a) > get(b) ? 1 : 0));
    sort('Bound').click();
    equal(names(), sorted((light) => light.bound, -1).map((light) => light.name).join('|'), 'sorted by bound');
    equal(sort('Bound').closest('th').getAttribute('aria-sort'), 'descending', 'aria-sort of the bound');
    sort('Bound').click();
    equal(names(), sorted((light) => light.bound, 1).map((light) => light.name).join('|'), 'sorted by bound, rising');
    sort('Near').click();
    equal(rows()[0].querySelector('.name').textContent, sorted((light) => light.near_frames, -1)[0].name, 'sorted by frames near');
    for (const row of rows()) {
      const light = lights.find((candidate) => candidate.name === row.querySelector('.name').textContent);
      equal(row.querySelector('.why').textContent, light.why, 'reason');
      const strip = row.querySelector('.course');
      equal(Boolean(strip), object.truth.length > 1, 'course over time');
      if (!strip) continue;
      const length = (role) => light.roles.filter(([, name]) => name === role).reduce((sum, [frames]) => sum + frames, 0);
      equal(length('near'), light.near_frames, 'frames near');
      equal(length('blended'), light.blend_frames, 'frames blended');
      equal(length('near') + length('blended') + length('far') + length('culled'), busiest.frames.length, 'every frame has a role');
      equal(all(strip, 'rect.role-near').length, light.roles.filter(([, name]) => name === 'near').length + light.blend_frames, 'rectangles of the strip');
      check(!/NaN|Infinity/.test(strip.outerHTML), 'a coordinate of the strip is no number');
    }
    if (!more.hidden) more.click();
    equal(rows().length, Math.min(20, lights.length), 'first lights again');
  }

  /** One card for each budget that objects share, with a row for each of them. */
  function checkBudgets() {
    const expected = data.scenes.flatMap((scene, i) => scene.budgets.map((budget) => ({budget,
      sharing: data.objects.filter((object) => object.scene_index === i && object.rigs.some((rig) => rig.spec === budget.spec && rig.budget?.alone))})))
      .filter(({sharing}) => sharing.length);
    const cards = all(document, '.budget');
    equal(cards.length, expected.length, 'budgets');
    for (const [i, {budget, sharing}] of expected.entries()) {
      check(cards[i].querySelector('.facts').textContent.includes(budget.spec), 'rig of the budget');
      equal(cards[i].textContent.includes('too long in'), budget.frames_over > 0, 'frames over the budget');
      equal(all(cards[i], 'tbody .name').map((name) => name.textContent).join('|'), sharing.map(({name}) => name).join('|'), 'objects that share');
      const losers = sharing.filter((object) => object.rigs.find((rig) => rig.spec === budget.spec).budget.gave_up).length;
      equal(cards[i].querySelector('.verdict').textContent.startsWith(`${losers} of ${sharing.length} object`), losers > 0, 'how many give something up');
      for (const [row, object] of sharing.entries()) {
        const {budget: use} = object.rigs.find((rig) => rig.spec === budget.spec);
        const cells = all(all(cards[i], 'tbody tr')[row], '.alone').map((cell) => cell.textContent);
        equal(cells.length, 5, 'figures alone');
        if (use.gave_up) check(cells[2].startsWith('alone '), `total error alone of ${object.name}`);
      }
    }
  }

  /** A card for each scene with disk lights: a row a method, and each disk with its reason under the rig chosen. */
  function checkDisks() {
    const scenes = data.scenes.filter((scene) => scene.disks);
    const cards = all(document, 'section.disks');
    equal(cards.length, scenes.length, 'scenes with disks');
    for (const [i, {disks}] of scenes.entries()) {
      const methods = all(cards[i], '.disk-methods tbody tr');
      equal(methods.map((row) => row.querySelector('.name').firstChild.textContent).join('|'), disks.methods.map(({method}) => method).join('|'), 'methods');
      equal(methods.map((row) => row.querySelector('td').textContent === '–').join('|'), disks.methods.map(({sh}) => sh === null).join('|'), 'a dash where a method has no SH');
      equal(cards[i].querySelector('.verdict').textContent, disks.choice, 'choice');
      const groups = [...new Set(disks.uses.map((use) => `${use.object}, ${use.rig}`))];
      const buttons = all(cards[i], '[aria-label="Rig"] button');
      equal(buttons.length, groups.length > 1 ? groups.length : 0, 'rigs with disks');
      for (const [g, group] of groups.entries()) {
        buttons[g]?.click();
        const uses = disks.uses.filter((use) => `${use.object}, ${use.rig}` === group);
        const rows = all(cards[i], '.light-use tbody tr');
        equal(rows.length, uses.length, 'disks');
        for (const row of rows) {
          const use = uses.find(({light}) => light === row.querySelector('.name').textContent);
          equal(all(row, 'td').map((cell) => cell.textContent).join('|'), `${use?.method}|${use?.why}`, 'method and reason');
        }
        equal(rows[0].querySelector('.text').textContent.startsWith('near'), uses.some(({method}) => method.startsWith('near')), 'near disks first');
      }
    }
  }

  async function run() {
    await drawn();
    const sections = all(document, 'section.object');
    equal(sections.length, data.objects.length, 'sections');
    for (const [i, object] of data.objects.entries()) {
      equal(sections[i].querySelector('h2').textContent, object.name, 'name as text');
      equal(Boolean(sections[i].querySelector('.gallery')), object.pictures.length > 0, 'gallery');
      checkTable(sections[i], object);
      if (object.pictures.length) checkGallery(sections[i], object);
      equal(Boolean(sections[i].querySelector('.plot[tabindex]')), object.truth.length > 1, 'time chart');
      if (object.truth.length > 1) checkTimeChart(sections[i], object);
      equal(all(sections[i], '.point').length, object.rigs.length > 1 ? object.rigs.length : 0, 'points');
      if (object.rigs.length > 1) checkCostChart(sections[i], object);
      equal(Boolean(sections[i].querySelector('.light-use')), object.rigs.some((rig) => rig.lights.length), 'table of lights');
      if (sections[i].querySelector('.light-use')) checkLights(sections[i], object);
    }
    checkBudgets();
    checkDisks();
    const root = document.documentElement;
    const theme = document.getElementById('theme');
    theme.click();
    const chosen = root.dataset.theme;
    const background = getComputedStyle(document.body).backgroundColor;
    theme.click();
    check(root.dataset.theme !== chosen && getComputedStyle(document.body).backgroundColor !== background, 'theme');
    check(document.title.startsWith('Rigel report: '), `title: ${document.title}`);
    equal(document.querySelector('footer code').textContent, data.command, 'command line');
    check(root.scrollWidth <= root.clientWidth, `the page is wider than its window: ${root.scrollWidth} > ${root.clientWidth}`);
    check(all(document, 'button').every((node) => node.textContent.trim()), 'a button without a name');
    const ids = all(document, '[id]').map((node) => node.id);
    equal(new Set(ids).size, ids.length, 'unique ids');
    check(all(document, 'nav a').every((link) => document.getElementById(link.hash.slice(1))), 'a link of the navigation leads nowhere');
    check(all(document, 'script').length === 4, `${all(document, 'script').length} scripts, not the page's own and this one`);
    equal(performance.getEntriesByType('resource').filter((entry) => !entry.name.startsWith('data:')).length, 0, 'files fetched');
    check(checks > 15, 'hardly anything was checked');
  }

  drive(run);
})();
