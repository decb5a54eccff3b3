// Pictures of a report: wipe, flicker, zoom, time, exposure, thumbnails, and the numbers under the cursor.
import assert from 'node:assert/strict';
import {existsSync} from 'node:fs';
import path from 'node:path';
import {inflateSync} from 'node:zlib';
import {halfToNumber, readExr} from './exr.mjs';
import {fileOf, pageTest, reports, settled} from './harness.mjs';

/** The first object with pictures, on screen and drawn: {gallery, object, frames, section}. */
async function openGallery(page, data) {
  const index = data.objects.findIndex((object) => object.pictures.length && object.mean_irradiance > 0);
  if (index < 0) return null;
  const section = page.locator('section.object').nth(index);
  await section.evaluate((node) => {
    for (let up = node; up; up = up.parentElement) if (up.tagName === 'DETAILS') up.open = true;
  });
  const gallery = section.locator('.gallery');
  await gallery.locator('.compare').scrollIntoViewIfNeeded();
  await drawn(gallery);
  const frames = await page.evaluate((i) => JSON.parse(document.getElementById('picture-data').textContent).objects[i], index);
  return {gallery, section, object: data.objects[index], frames};
}

/** Waits until the panes show what was asked for last. */
async function drawn(gallery) {
  await gallery.locator('.viewer[data-mode]').waitFor();
  await settled(gallery.page());
}

const press = (gallery, group, label) => gallery.getByRole('group', {name: group, exact: true}).getByRole('button', {name: label, exact: true}).click();
/** A number that changes with what a pane shows. */
const sum = (pane) => pane.locator('canvas').evaluate((canvas) => {
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', {willReadFrequently: true});
  copy.drawImage(canvas, 0, 0);
  const {data} = copy.getImageData(0, 0, canvas.width, canvas.height);
  return data.reduce((total, byte, i) => (total + (i % 251 + 1) * byte) % 2147483647, 0);
});
/** What is not unpacked yet is drawn later. */
const changes = async (pane, act, what) => {
  const before = await sum(pane);
  await act();
  for (let tries = 0; tries < 50; ++tries) {
    await settled(pane.page());
    if (await sum(pane) !== before) return;
    await pane.page().waitForTimeout(100);
  }
  assert.fail(`${what}: the picture is the same`);
};

for (const name of reports) {
  pageTest('pictures: wipe, zoom, false colours, frames, thumbnails', name, async ({page, data}) => {
    const opened = await openGallery(page, data);
    if (!opened) return;
    const {gallery, section, object, frames} = opened;
    const compare = gallery.locator('.compare .stage');
    const wrong = gallery.locator('.wrong .stage');
    const wipe = gallery.getByLabel('Wipe: how much');
    const share = () => compare.evaluate((node) => parseFloat(node.style.getPropertyValue('--wipe')));

    // Wipe: slider, drag, and a drag that leaves the picture.
    await wipe.fill('20');
    assert.equal(await share(), 20, 'slider');
    await wipe.press('ArrowRight');
    assert.equal(await share(), 21, 'arrow right');
    const box = await compare.boundingBox();
    await page.mouse.move(box.x + 0.75 * box.width, box.y + box.height / 2);
    await page.mouse.down();
    assert.ok(Math.abs(await share() - 75) < 1, `press on the picture: ${await share()}`);
    await page.mouse.move(box.x + box.width + 60, box.y + box.height / 2);
    assert.equal(await share(), 100, 'drag beyond the picture');
    await page.mouse.up();
    await page.mouse.move(box.x + 10, box.y + box.height / 2);
    assert.equal(await share(), 100, 'no drag after the release');
    await wipe.fill('50');

    // What is shown.
    await changes(compare, () => press(gallery, 'Picture', 'Clay'), 'clay');
    await changes(compare, () => press(gallery, 'Picture', 'False colour'), 'false colours of irradiance');
    await press(gallery, 'Picture', 'Shaded');
    await changes(compare, () => gallery.getByLabel('Exposure').fill('2'), 'exposure');
    await gallery.getByLabel('Exposure').dblclick();
    await changes(wrong, () => press(gallery, 'Error', 'Absolute'), 'absolute error');
    await changes(wrong, () => gallery.getByLabel('Scale', {exact: true}).press('ArrowRight'), 'scale');
    await press(gallery, 'Unit', 'W/m²');
    assert.match(await gallery.locator('.wrong .ticks').textContent(), /W\/m²/, 'legend in W/m²');

    await press(gallery, 'Unit', '% of mean');

    // FLIP of what is shown is that of the files, as the program computed it.
    const spec = await compare.locator('.tag.left').textContent();
    await press(gallery, 'Error', 'FLIP');
    const {flip: written} = object.pictures.find((picture) => picture.label === spec);
    const mean = async () => Number((await wrong.locator('.tag.left').textContent()).match(/FLIP, mean ([\d.]+)/)[1]);
    // Half floats and a matrix of fewer digits; 0.0005 of it is the text's own rounding.
    assert.ok(!frames.some(({exact}) => exact) || Math.abs(await mean() - written) < 0.0015, `FLIP ${await mean()}, not ${written}`);
    await gallery.getByLabel('Exposure').fill('-4');
    await settled(page);
    assert.ok(await mean() <= written, 'in the dark less is seen');
    await gallery.getByLabel('Exposure').dblclick();
    await press(gallery, 'Error', 'Signed');

    // One magnifying glass over all panes.
    for (const [how, act] of [['button', () => gallery.getByRole('button', {name: 'Zoom in'}).click()], ['key', () => compare.press('+')],
      ['wheel', async () => {
        await page.waitForTimeout(500);  // the wheel scrolls the page while the page is scrolling
        await compare.hover();
        await page.mouse.wheel(0, -200);
      }]]) {
      const before = await sum(compare);
      await changes(wrong, act, `zoom by ${how}`);
      assert.notEqual(await sum(compare), before, `zoom by ${how}: the panes are not linked`);
    }
    const session = await page.context().newCDPSession(page);
    const level = async () => parseFloat(await gallery.locator('.zoom-level').textContent());
    const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
    await gallery.getByRole('button', {name: 'Show the whole picture'}).click();
    await compare.evaluate((node) => node.scrollIntoView({block: 'center', behavior: 'instant'}));
    const place = await compare.boundingBox();
    const [middle, row] = [place.x + place.width / 2, place.y + place.height / 2];
    await touch('touchStart', [middle - 20, row], [middle + 20, row]);
    for (const spread of [30, 45, 60]) await touch('touchMove', [middle - spread, row], [middle + spread, row]);
    await touch('touchEnd');
    assert.ok(Math.abs(await level() - 3) < 0.2, `pinch to three times the width: ${await level()}`);
    await changes(wrong, async () => {
      await page.mouse.move(middle, row - place.height / 4);
      await page.mouse.down();
      await page.mouse.move(middle + 40, row - place.height / 4 + 30, {steps: 3});
      await page.mouse.up();
    }, 'a drag moves what is magnified');
    await gallery.getByRole('button', {name: 'Show the whole picture'}).click();
    assert.equal(await gallery.locator('.zoom-level').textContent(), '1×');

    // Side by side, and in turn: of the rig that is most wrong, for the best may be right in every pixel.
    const [worst] = [...object.rigs].sort((a, b) => b.total.rms - a.total.rms);
    if (object.rigs.length > 1) await press(gallery, 'Rig', worst.spec);
    await press(gallery, 'Compare', 'Side by side');
    assert.ok(await gallery.locator('.second .stage').isVisible(), 'truth beside the rig');
    await press(gallery, 'Compare', 'Flicker');
    await gallery.getByRole('button', {name: 'Hold'}).click();
    await changes(compare, () => gallery.getByRole('button', {name: 'Swap'}).click(), 'swap');
    await press(gallery, 'Compare', 'Wipe');

    // Frames.
    assert.equal(await gallery.locator('.player').count(), frames.length > 1 ? 1 : 0, 'a slider where there is something to slide');
    if (frames.length > 1) {
      await changes(compare, () => gallery.getByLabel('Frame', {exact: true}).fill('0'), 'first frame');
      await settled(page);
      assert.match(await gallery.locator('.time').textContent(), new RegExp(`frame ${frames[0].frame}$`));
      await gallery.getByRole('button', {name: '▶ Play'}).click();
      await page.waitForFunction((node) => !node.textContent.endsWith('frame 0'), await gallery.locator('.time').elementHandle());
      await gallery.getByRole('button', {name: 'Pause'}).click();
      const full = frames.find((frame) => frame.exact);
      const smaller = frames.findIndex((frame) => !frame.exact);
      if (full && smaller >= 0) {
        await gallery.getByLabel('Frame', {exact: true}).fill(String(smaller));
        await gallery.getByRole('button', {name: 'Full picture'}).click();
        assert.match(await gallery.locator('.time').textContent(), new RegExp(`frame ${full.frame}$`));
      }
    }

    // Thumbnails choose, and all that shows the rig follows.
    const thumbnails = gallery.locator('.thumbnail');
    assert.equal(await thumbnails.count(), object.rigs.length + 1, 'thumbnails');
    await gallery.locator('button.thumbnail').first().click();
    await settled(page);
    assert.equal(await compare.locator('.tag.left').textContent(), object.rigs[0].spec);
    assert.equal(await gallery.getByRole('group', {name: 'Rig', exact: true}).getByRole('button', {pressed: true}).textContent(), object.rigs[0].spec);
    await changes(thumbnails.nth(1), async () => {
      await press(gallery, 'Show', 'Differences');
      await page.waitForTimeout(200);
    }, 'differences as thumbnails');
    assert.equal(await section.locator('img').count(), 0, 'pictures are drawn, not loaded');
  });

  pageTest('pictures: values under the cursor are the stored numbers', name, async ({page, data}) => {
    const opened = await openGallery(page, data);
    if (!opened) return;
    const {gallery, object, frames} = opened;
    const frame = frames.find(({exact}) => exact) ?? frames[0];  // where there are many objects none is in full
    const compare = gallery.locator('.compare .stage');
    const spec = await compare.locator('.tag.left').textContent();
    const folder = path.dirname(fileOf(name));
    const fileNamed = (label) => path.join(folder, object.pictures.find((picture) => picture.label === label).image_exr);
    const files = frame.exact && existsSync(fileNamed(spec)) ? {rig: readExr(fileNamed(spec)).channels, truth: readExr(fileNamed('truth')).channels} : null;
    const share = inflateSync(Buffer.from(frame.coverage, 'base64')).subarray(0, frame.width * frame.height);

    const box = await compare.boundingBox();
    const covered = [...share.keys()].filter((i) => share[i]);
    const pixels = [0.02, 0.2, 0.4, 0.6, 0.8, 0.98].map((part) => covered[Math.floor(part * covered.length)]);
    const bare = [...share.keys()].filter((i) => !share[i]);
    for (const at of [...pixels, bare[Math.floor(bare.length / 3)]]) {
      const [x, y] = [at % frame.width, Math.floor(at / frame.width)];
      await page.mouse.move(box.x + (x + 0.5) / frame.width * box.width, box.y + (y + 0.5) / frame.height * box.height);
      await settled(page);
      const caption = await gallery.locator('.values caption').textContent();
      assert.ok(caption.startsWith(`Pixel ${x}, ${y}`), `${caption}, not ${x}, ${y}`);
      assert.equal(caption.includes('not on the object'), share[at] === 0, caption);
      if (!share[at]) continue;
      const rows = await gallery.locator('.values tbody tr').evaluateAll((all) => all.map((row) => [...row.querySelectorAll('td[data-value]')].map((cell) => [Number(cell.dataset.value), cell.textContent])));
      for (let c = 0; c < 3; ++c) {
        const [[own, ownText], [truth], [difference], [relative]] = rows.map((row) => row[c]);
        if (files) {
          assert.equal(own, files.rig[`irradiance.${'RGB'[c]}`][at], 'rig');
          assert.equal(truth, files.truth[`irradiance.${'RGB'[c]}`][at], 'truth');
        }
        assert.equal(difference, own - truth, 'difference');
        assert.equal(relative, difference / object.mean_irradiance, 'relative');
        assert.ok(Math.abs(Number(ownText) - own) <= 5e-5 * own, `five digits of ${own}: ${ownText}`);
        assert.ok(Array.from({length: 0x7c00}, (_, bits) => halfToNumber(bits) * frame.scale).includes(own), `${own} is no half float`);
      }
    }

    // By keyboard: a pixel a step.
    await compare.focus();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    const column = async () => Number((await gallery.locator('.values caption').textContent()).match(/\d+/)[0]);
    await settled(page);
    const before = await column();
    await compare.press('ArrowRight');
    assert.equal(await column(), before + 1, 'arrow right');
    await compare.press('Shift+ArrowLeft');
    assert.equal(await column(), before - 9, 'shift and arrow left');
    await compare.press('Escape');
    assert.match(await gallery.locator('.values caption').textContent(), /Point at/);
  });
}

pageTest('pictures: flicker waits where motion is to be reduced', reports[0], async ({page, data}) => {
  const opened = await openGallery(page, data);
  if (!opened) return;
  const {gallery} = opened;
  await press(gallery, 'Compare', 'Flicker');
  assert.ok(await gallery.getByRole('button', {name: '▶ Run'}).isVisible(), 'held from the start');
}, {reducedMotion: 'reduce'});

pageTest('pictures: a browser without DecompressionStream says so', reports[0], async ({page, data}) => {
  if (!data.objects.some((object) => object.pictures.length)) return;
  await page.addInitScript(() => { delete globalThis.DecompressionStream; });
  await page.reload();
  assert.match(await page.locator('.gallery').first().textContent(), /cannot unpack/);
});
