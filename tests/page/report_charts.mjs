// The two charts of an object: error over time, and error against cost.
import assert from 'node:assert/strict';
import {inPage, laptop, pageTest, phone, reports, settled} from './harness.mjs';

for (const name of reports) {
  pageTest('error over time follows its buttons, shows every rig, and says the figures of a moment', name, ({page}) => inPage(page, async ({check, equal, all, press, pointer, button, drawn, data}) => {
    const places = all(document, 'section.object').map((section) => section.querySelector('.plot.time'));
    equal(places.map(Boolean).join(), data.objects.map(({truth}) => truth.length > 1).join(), 'time charts');
    for (const [i, object] of data.objects.entries()) {
      if (!places[i]) continue;
      const place = places[i];
      const card = place.closest('.card');
      const lines = () => all(place, '.error-lines path');
      const values = () => all(card, '.legend .value').map((value) => value.textContent);
      equal(lines().length, object.rigs.length, 'lines');
      const [first] = all(card, '.legend button');
      first.click();
      equal(lines().length, object.rigs.length - 1, 'lines without the first rig');
      equal(first.getAttribute('aria-pressed'), 'false', 'legend');
      first.click();
      const shape = lines()[0].getAttribute('d');
      check(!/NaN|Infinity|undefined/.test(place.innerHTML), 'a coordinate of the chart is no number');
      button(card, 'Scale', 'Linear').click();
      check(lines()[0].getAttribute('d') !== shape, 'linear looks like logarithmic');
      check(!/NaN|Infinity|undefined/.test(place.innerHTML), 'a coordinate of the linear chart is no number');
      button(card, 'Error', 'Spatial').click();
      check(place.textContent.includes('spatial RMS'), 'title follows the error');
      button(card, 'Error', 'Total').click();
      button(card, 'Scale', 'Log').click();

      const last = object.truth[object.truth.length - 1];
      const whole = values().join();
      press(place, 'End');
      equal(place.querySelector('.flag').textContent, `${last.time.toFixed(2)} s`, 'flag at the last frame');
      check(!place.querySelector('.moment').hidden, 'the moment is marked');
      press(place, 'Home');
      const atStart = values().join();
      // Clips loop: the last frame may be the first once more.
      const far = object.rigs.map(({frames}) => frames.map(({total_rms: rms}) => Math.abs(rms - frames[0].total_rms)))
        .reduce((most, rig) => (Math.max(...rig) > Math.max(...most) ? rig : most));
      for (let i = far.indexOf(Math.max(...far)); i > 0; --i) press(place, 'ArrowRight');
      check(values().join() !== atStart, 'the legend says the figures of the moment');
      check(place.querySelector('.irradiance .value').textContent.endsWith('W/m²'), 'irradiance of the moment');
      press(place, 'Escape');
      check(place.querySelector('.moment').hidden, 'Escape takes the mark away');
      equal(values().join(), whole, 'and the legend says the whole run');
      const box = place.getBoundingClientRect();
      pointer(place, 'pointermove', box.left + 46 + (box.width - 56) / 2);
      equal(place.querySelector('.flag').textContent, `${object.truth[Math.floor(object.truth.length / 2)].time.toFixed(2)} s`, 'the pointer moves the mark');
      pointer(place, 'pointerleave', 0);

      const chosen = object.rigs.find((rig) => rig.spec === place.closest('.object').querySelector('tr.chosen .pick')?.textContent);
      const chooses = (rig) => rig.frames.some((frame) => frame.near.length || frame.sh_vectors !== rig.frames[0].sh_vectors);
      const estimates = chosen?.frames.every((frame) => typeof frame.total_estimate === 'number');
      equal(all(place, '.estimate-line path').length, estimates ? 1 : 0, 'estimate of the chosen rig');
      equal(all(place, '.vectors-line path').length, object.rigs.filter(chooses).length, 'SH vectors of the rigs that choose');
      equal(all(place, '.near-line path').length, object.rigs.filter(chooses).length, 'near lights of the rigs that choose');
      equal(Boolean(place.querySelector('.jumps')), object.rigs.some((rig) => rig.frames.some((frame) => frame.jump > 0)), 'jumps');
      const behind = card.querySelector('.behind');
      behind.open = true;
      await drawn();
      equal(all(behind, 'tbody tr').length, object.truth.length, 'rows of the table behind');
      equal(all(behind, 'thead th').length, object.rigs.length + 3, 'columns of the table behind');
      behind.open = false;
    }
  }));

  pageTest('error against cost follows its buttons; a point chooses its rig', name, ({page}) => inPage(page, ({check, equal, all, press, button, data}) => {
    const sections = all(document, 'section.object');
    for (const [i, object] of data.objects.entries()) {
      const points = () => all(sections[i], '.points > *');
      equal(points().length, object.rigs.length > 1 ? object.rigs.length : 0, 'points');
      if (object.rigs.length < 2) continue;
      const card = points()[0].closest('.card');
      const pointOf = (spec) => points().find((point) => point.dataset.spec === spec);
      const at = (spec) => pointOf(spec).getAttribute('transform') ?? pointOf(spec).getAttribute('cx');
      const {spec} = object.rigs[object.rigs.length - 1];
      const before = at(spec);
      button(card, 'Cost', 'Fit').click();
      check(at(spec) !== before, 'the cost axis does nothing');
      check(!/NaN|Infinity|undefined/.test(card.innerHTML), 'a coordinate of the cost chart is no number');
      equal(all(card, '.point-name').map((node) => node.textContent).sort().join('|'), object.rigs.map((rig) => rig.spec).sort().join('|'), 'names');
      equal(points().filter((point) => point.getAttribute('tabindex') === '0').length, 1, 'one tab stop');
      pointOf(object.rigs[0].spec).focus();
      check(card.querySelector('[aria-live]').textContent.startsWith(` ${object.rigs[0].spec}: `), 'the focus says the figures');
      press(pointOf(object.rigs[0].spec), 'Enter');
      equal(sections[i].querySelector('tr.chosen .pick').textContent, object.rigs[0].spec, 'a point chooses its rig');
      button(card, 'Cost', 'Modelled').click();
    }
  }));
}

pageTest('the mouse moves the moment in the chart and in the lights alike', 'made-up', async ({page}) => {
  const chart = page.locator('.plot.time').first();
  await chart.scrollIntoViewIfNeeded();
  const box = await chart.boundingBox();
  await page.mouse.move(box.x + box.width * 0.6, box.y + 120);
  assert.match(await page.locator('.flag').first().textContent(), /^\d+\.\d\d s$/);
  await page.locator('.light-use.pointing').first().waitFor();
  await page.mouse.move(2, box.y + 120);
  assert.equal(await page.locator('.moment').first().isHidden(), true);
  const strip = page.locator('.course-strip').first();
  await strip.scrollIntoViewIfNeeded();
  const half = await strip.boundingBox();
  await page.mouse.move(half.x + half.width / 2, half.y + half.height / 2);
  await settled(page);
  assert.equal(await page.locator('.moment').first().isHidden(), false);
  assert.match(await page.locator('.now').first().textContent(), /near|far|culled/);
}, {views: [laptop]});

pageTest('a finger leaves the moment where it was', 'made-up', async ({page}) => {
  const chart = page.locator('.plot.time').first();
  await chart.dispatchEvent('pointerdown', {pointerType: 'touch', clientX: 200, clientY: 10});
  await chart.dispatchEvent('pointerleave', {pointerType: 'touch'});
  assert.equal(await page.locator('.moment').first().isHidden(), false);
}, {views: [phone]});

pageTest('arrow keys walk through frames and rigs', 'made-up', async ({page, data}) => {
  await page.locator('.plot.time').first().focus();
  for (const key of ['Home', 'ArrowRight', 'ArrowRight', 'ArrowLeft', 'PageDown']) await page.keyboard.press(key);
  assert.equal(await page.locator('.flag').first().textContent(), `${data.objects[0].truth[11].time.toFixed(2)} s`);
  assert.match(await page.locator('.over-time [aria-live]').first().textContent(), /^0\.37 s: auto .*%$/);
  await page.locator('.points > [tabindex="0"]').first().focus();
  await page.keyboard.press('Home');
  const seen = [];
  for (let i = 0; i < data.objects[0].rigs.length; ++i) {
    seen.push(await page.evaluate(() => document.activeElement.dataset.spec));
    await page.keyboard.press('ArrowRight');
  }
  assert.deepEqual(seen.sort(), data.objects[0].rigs.map(({spec}) => spec).sort());
  await page.keyboard.press('Enter');
  assert.equal(await page.locator('tr.chosen .pick').first().textContent(), await page.evaluate(() => document.activeElement.dataset.spec));
});
