// Causes of the error, errors by body part, and their histogram.
import assert from 'node:assert/strict';
import {inPage, laptop, pageTest, reports, settled} from './harness.mjs';

for (const name of reports) {
  pageTest('causes add up as drawn, say what to do, and choose rigs', name, ({page}) => inPage(page, async ({check, equal, all, button, drawn, data}) => {
    const sections = all(document, 'section.object');
    for (const [i, object] of data.objects.entries()) {
      const card = sections[i].querySelector('.error-parts');
      const rigs = object.rigs.filter((rig) => rig.parts);
      equal(Boolean(card), rigs.some((rig) => rig.parts.total > 0), 'a card where there are parts');
      if (!card) continue;
      const rows = () => all(card, '.bar-row');
      equal(rows().length, rigs.length, 'a bar a rig');
      for (const scale of ['One scale', 'Shares']) {
        button(card, 'Bars', scale).click();
        await drawn();
        check(!/NaN|Infinity|undefined/.test(card.innerHTML), 'a number of the card is none');
        const ticks = all(card, '.total-tick').map((tick) => Number(tick.getAttribute('x1')));
        const pieces = all(card, '.pieces rect');
        const start = Math.min(...pieces.map((piece) => Number(piece.getAttribute('x'))));
        const unit = (ticks[0] - start) / (scale === 'Shares' ? 1 : rigs[0].parts.total);
        const each = pieces.length / rigs.length;
        rigs.forEach((rig, r) => {
          const widths = pieces.slice(each * r, each * (r + 1)).reduce((sum, piece) => sum + Number(piece.getAttribute('width')), 0);
          const scaled = (value) => unit * value / (scale === 'Shares' ? rig.parts.total : 1);
          check(Math.abs(start + widths + scaled(rig.parts.interaction) - ticks[r]) < 1, `${rig.spec}: parts and interaction end at the total`);
          check(Math.abs(start + scaled(rig.parts.total) - ticks[r]) < 1, `${rig.spec}: the tick is the total`);
        });
      }
      const last = rigs[rigs.length - 1];
      rows()[rigs.length - 1].focus();
      check(card.querySelector('[aria-live]').textContent.includes('RMS without'), 'the focus says the figures');
      rows()[rigs.length - 1].dispatchEvent(new MouseEvent('click', {bubbles: true}));
      check(card.querySelector('.verdict').textContent.startsWith(`${last.spec}: `), 'the sentence is on the rig chosen');
      check(/ dominates; without it | weigh about the same |nothing is left to gain/.test(card.querySelector('.verdict').textContent), 'the sentence names the largest part');
      equal(rows().filter((row) => row.getAttribute('aria-pressed') === 'true').length, 1, 'one is chosen');
      equal(sections[i].querySelector('tr.chosen .pick').textContent, last.spec, 'the table follows');
      const behind = card.querySelector('.behind');
      behind.open = true;
      await drawn();
      equal(all(behind, 'tbody tr').length, rigs.length, 'rows of the table behind');
      behind.open = false;
    }
  }));

  pageTest('body parts and sizes follow the rig and their buttons', name, ({page}) => inPage(page, async ({check, equal, all, press, button, drawn, data}) => {
    const sections = all(document, 'section.object');
    for (const [i, object] of data.objects.entries()) {
      const rigs = object.rigs.filter((rig) => rig.body_parts);
      const card = sections[i].querySelector('.by-part');
      equal(Boolean(card), rigs.some((rig) => rig.body_parts.length > 1), 'a card where there are body parts');
      equal(Boolean(sections[i].querySelector('.by-size')), object.rigs.some((rig) => rig.histogram), 'a card where there are histograms');
      if (!card) continue;
      const parts = rigs[0].body_parts;
      for (const measure of ['Mean', 'Max', 'Share', 'RMS']) {
        button(card, 'Error', measure).click();
        await drawn();
        equal(all(card, '.bar-row').length, parts.length, 'bars');
        check(!/NaN|Infinity|undefined/.test(card.querySelector('.plot').innerHTML), 'a number of the chart is none');
      }
      const [first, second] = all(card, '.bar-row');
      first.focus();
      press(first, 'ArrowDown');
      equal(document.activeElement, second, 'arrow keys');
      check(card.querySelector('[aria-live]').textContent.startsWith(parts[1].name), 'the focus says the figures');

      const sizes = sections[i].querySelector('.by-size');
      const place = sizes.querySelector('.plot');
      const said = () => sizes.querySelector('[aria-live]').textContent;
      for (const kind of ['Signed', 'Size']) {
        button(sizes, 'Errors', kind).click();
        await drawn();
        check(!/NaN|Infinity|undefined/.test(sizes.innerHTML), 'a number of the histogram is none');
        const whole = said();
        press(place, 'End');
        check(/ to .*lie below/.test(said()), 'a bin says its figures');
        press(place, 'Escape');
        equal(said(), whole, 'and Escape the whole');
      }
      check(said().startsWith('Half of all errors are below'), 'percentiles in words');
      const other = rigs[0].spec;
      all(sections[i], 'tr .pick').find((pick) => pick.textContent === other)?.click();
      await drawn();
      equal(sizes.querySelector('.of-rig').textContent, other, 'the histogram follows the rig');
      equal(card.querySelector('.of-rig').textContent, other, 'so do the body parts');
    }
  }));
}

pageTest('the table behind the histogram opens by a click', 'made-up', async ({page, data}) => {
  const behind = page.locator('.by-size .behind').first();
  await behind.locator('summary').click();
  await settled(page);
  assert.equal(await behind.locator('tbody tr').count(), data.objects[0].rigs.length);
}, {views: [laptop]});
