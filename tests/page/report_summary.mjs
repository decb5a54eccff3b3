// The top of the page: which rig for each object, what it costs, what it loses, why; and the command line.
import assert from 'node:assert/strict';
import {inPage, laptop, pageTest, phone, reports} from './harness.mjs';

for (const name of reports) {
  pageTest('the summary answers for every object with the figures of its rig', name, ({page}) => inPage(page, ({check, equal, all, data}) => {
    const rows = all(document, '.answers tbody tr');
    equal(rows.length, data.objects.length, 'rows');
    const three = (value) => Number(Number(value).toPrecision(3));
    data.objects.forEach((object, i) => {
      const cell = (label) => rows[i].querySelector(`[data-label^="${label}"]`)?.textContent;
      const number = (label) => Number(cell(label).replaceAll(',', ''));
      const {spec, advised} = object.verdict;
      const rig = object.rigs.find((candidate) => candidate.spec === spec);
      equal(rows[i].querySelector('.name a').textContent, object.name, 'name');
      equal(rows[i].querySelector('.advice .spec').textContent, spec, 'rig');
      equal(rows[i].classList.contains('unadvised'), !advised, 'advised');
      check(Math.abs(number('Fit') - rig.fit_us) <= 0.006 * rig.fit_us, `fit ${cell('Fit')}`);
      check(Math.abs(number('Shading') - rig.shade_ns_per_point) <= 0.006 * rig.shade_ns_per_point, `shading ${cell('Shading')}`);
      equal(number('Size'), rig.bytes, 'bytes');
      equal(number('Total RMS'), three(100 * rig.total.rms), 'total RMS');
      equal(number('Spatial RMS'), three(100 * rig.spatial.rms), 'spatial RMS');
      check(cell('Why').length > 15, `why: ${cell('Why')}`);
      if (data.objects.some(({truth}) => truth.length > 1)) equal(cell('Popping') === '–', rig.max_jump === null, 'popping');
    });
  }));
}

pageTest('one glance: the whole answer is in the first window', 'made-up', async ({page, view}) => {
  const box = await page.locator('.answers tbody tr').first().boundingBox();
  assert.ok(box.y + box.height < view.height, `the first answer ends at ${box.y + box.height} of ${view.height}`);
});

pageTest('columns sort by mouse and by keyboard', 'crowd', async ({page, data}) => {
  const names = () => page.locator('.answers tbody .name a').allTextContents();
  await page.locator('.answers .sort', {hasText: 'Object'}).click();
  assert.deepEqual(await names(), data.objects.map((object) => object.name).sort());
  await page.locator('.answers .sort', {hasText: 'Object'}).focus();
  await page.keyboard.press('Enter');
  assert.deepEqual(await names(), data.objects.map((object) => object.name).sort().reverse());
  assert.equal(await page.locator('.answers th[aria-sort="descending"]').count(), 1);
}, {views: [laptop, phone]});

pageTest('the command line is copied', 'made-up', async ({page, data}) => {
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.locator('.command .copy').click();
  await page.locator('.command .copy', {hasText: 'Copied'}).waitFor();
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), data.command);
}, {views: [laptop, phone]});
