// The 3-D view: opens, turns by mouse and keys, follows time and the rig chosen, says what is under the pointer.
import assert from 'node:assert/strict';
import {laptop, pageTest, phone, reports, settled} from './harness.mjs';

const webgl = {webgl: true, views: [laptop]};
const onPhone = {webgl: true, views: [phone]};
const card = (page) => page.locator('.view3d').first();
const canvas = (page) => card(page).locator('canvas');
const label = (page) => canvas(page).getAttribute('aria-label');

/** Scrolled to, and drawn. */
async function opened(page) {
  await card(page).scrollIntoViewIfNeeded();
  await card(page).locator('.view3d-message').waitFor({state: 'hidden'});
  await settled(page);
}

/** The canvas as it stands on the screen, without what lies over it. */
async function pixels(page) {
  await settled(page);
  return (await canvas(page).screenshot()).toString('base64');
}

async function changes(page, what, act) {
  const before = await pixels(page);
  await act();
  assert.notEqual(await pixels(page), before, `${what} changes nothing`);
}

const press = (page, key) => async () => {
  await canvas(page).focus();
  await canvas(page).press(key);
};

pageTest('draws more than a floor', 'made-up', async ({page}) => {
  await opened(page);
  assert.ok(await card(page).locator('.view3d-message').isHidden());
  for (const part of ['Box', 'Samples', 'Lights']) {
    const button = card(page).getByRole('button', {name: part, exact: true}).last();
    await changes(page, `hiding ${part}`, () => button.click());
    assert.equal(await button.getAttribute('aria-pressed'), 'false');
  }
  for (const surface of ['Signed', 'Lit by rig', 'Lit by truth', 'Error']) await changes(page, surface, () => card(page).getByRole('button', {name: surface, exact: true}).click());
}, onPhone);

pageTest('orbits', 'made-up', async ({page}) => {
  await opened(page);
  const box = await canvas(page).boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await changes(page, 'dragging', async () => {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 120, y + 40, {steps: 4});
    await page.mouse.up();
    await page.mouse.move(0, 0);
  });
  for (const key of ['ArrowLeft', 'ArrowUp', '+', '-', 'ArrowRight']) await changes(page, key, press(page, key));
  await changes(page, 'Home', press(page, 'Home'));
  await changes(page, 'showing the lights', () => card(page).locator('.view3d-tools').getByRole('button', {name: 'Lights'}).click());
}, {webgl: true});

pageTest('the wheel scrolls the page until the view is clicked', 'made-up', async ({page}) => {
  await opened(page);
  const box = await canvas(page).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  const scrolled = () => page.evaluate(() => scrollY);
  const before = await scrolled();
  await page.mouse.wheel(0, 40);
  await page.waitForFunction((y) => scrollY !== y, before);
  await canvas(page).click();
  const after = await scrolled();
  await changes(page, 'the wheel', () => page.mouse.wheel(0, 120));
  assert.equal(await scrolled(), after);
}, webgl);

pageTest('follows time, and time follows it', 'made-up', async ({page}) => {
  await opened(page);
  const slider = card(page).getByRole('slider');
  await slider.focus();
  await slider.press('Home');
  assert.match(await label(page), /0\.00 s/);
  await changes(page, 'the slider', () => slider.press('End'));
  assert.match(await label(page), /2\.00 s/);
  assert.match(await page.locator('.over-time .moment').first().textContent(), /2\.00 s/, 'the chart over time');
  await page.locator('.plot.time').first().focus();
  await page.locator('.plot.time').first().press('Home');
  assert.equal(await slider.inputValue(), '0');
  await slider.press('Home');
  await card(page).getByRole('button', {name: 'Play'}).click();
  await page.waitForFunction(() => Number(document.querySelector('.view3d input[type=range]').value) >= 2);
  await card(page).getByRole('button', {name: 'Pause'}).click();
  const held = await slider.inputValue();
  await page.waitForTimeout(900);
  assert.equal(await slider.inputValue(), held);
}, onPhone);

pageTest('shows the rig chosen for the object', 'made-up', async ({page, data}) => {
  await opened(page);
  for (const {spec} of data.objects[0].rigs.slice(0, 2)) {
    await card(page).getByRole('group', {name: 'Rig'}).getByRole('button', {name: spec, exact: true}).click();
    assert.ok((await label(page)).includes(`error of ${spec}`));
  }
  assert.match(await label(page), /near: none/);
  await card(page).getByRole('group', {name: 'Rig'}).getByRole('button', {name: 'auto', exact: true}).click();
  assert.doesNotMatch(await label(page), /near: none/);
}, onPhone);

pageTest('its scale has units and steps', 'made-up', async ({page}) => {
  await opened(page);
  const top = () => card(page).locator('.view3d-legend .ticks span').last().textContent();
  const before = await top();
  assert.match(before, /≥ [\d.]+\u00a0%/);
  const ramp = await card(page).locator('.view3d-legend .ramp').boundingBox();
  const last = await card(page).locator('.view3d-legend .ticks span').last().boundingBox();
  assert.ok(ramp.height > 4 && Math.abs(last.x + last.width - ramp.x - ramp.width) < 2, 'the scale has no colours over its figures');
  await changes(page, 'a finer scale', () => card(page).getByRole('button', {name: 'Finer scale'}).click());
  assert.notEqual(await top(), before);
  await card(page).getByRole('button', {name: 'Coarser scale'}).click();
  assert.equal(await top(), before);
}, onPhone);

pageTest('says what is under the pointer', 'made-up', async ({page, data}) => {
  await opened(page);
  const box = await canvas(page).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  const readout = card(page).locator('.view3d-readout');
  await readout.waitFor({state: 'visible'});
  const text = await readout.textContent();
  assert.match(text, /error, RMS over colour[\d.]+\u00a0%/);
  assert.match(text, /rig − truth, mean[+−][\d.]+\u00a0%/);
  assert.match(text, /exact irradiance[\d.]+ W\/m²/);
  // The made-up truth is at most 4 W/m² times 2.1, the error at most 40 %.
  assert.ok(Number(text.match(/colour([\d.]+)/)[1]) <= 40);
  assert.ok(Number(text.match(/irradiance([\d.]+)/)[1]) < 8.5);
  await page.mouse.move(box.x + 3, box.y + box.height - 3);
  await readout.waitFor({state: 'hidden'});
  // Some light is somewhere: its name, kind and reason.
  const names = data.scenes[0].lights.slice(0, 8).map(({name}) => name);
  await card(page).locator('.view3d-tools').getByRole('button', {name: 'Lights'}).click();
  await settled(page);
  let said = '';
  for (let y = 8; y < box.height && !names.some((name) => said.startsWith(name)); y += 12) {
    for (let x = 8; x < box.width && !names.some((name) => said.startsWith(name)); x += 12) {
      await page.mouse.move(box.x + x, box.y + y);
      said = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
        const node = document.querySelector('.view3d-readout');
        done(node.hidden ? '' : node.textContent);
      }))));
    }
  }
  assert.ok(names.some((name) => said.startsWith(name)), 'no light under the pointer anywhere');
  assert.match(said, /(near|far|culled)/);
}, onPhone);

pageTest('draws nothing while nothing changes', 'made-up', async ({page}) => {
  await opened(page);
  const calls = await page.evaluate(async () => {
    let frames = 0;
    const asked = window.requestAnimationFrame;
    window.requestAnimationFrame = (callback) => { ++frames; return asked.call(window, callback); };
    await new Promise((done) => setTimeout(done, 700));
    return frames;
  });
  assert.equal(calls, 0);
}, webgl);

pageTest('without WebGL there is a sentence', 'made-up', async ({page}) => {
  await card(page).scrollIntoViewIfNeeded();
  await page.waitForFunction(() => /WebGL/.test(document.querySelector('.view3d-message').textContent));
  assert.ok(await card(page).locator('.view3d-message').isVisible());
});

for (const name of reports) {
  pageTest('every view opens, one after another', name, async ({page}) => {
    const views = await page.locator('.view3d').all();
    // And back: only so many are kept open.
    for (const view of [...views, ...views.toReversed()]) {
      await view.scrollIntoViewIfNeeded();
      await view.locator('.view3d-message').waitFor({state: 'hidden'});
      assert.match(await view.locator('canvas').getAttribute('aria-label'), /Total RMS/);
    }
    assert.equal(views.length, {'made-up': 1, crowd: 3, smallest: 0, hostile: 1}[name] ?? views.length);
  }, onPhone);
}
