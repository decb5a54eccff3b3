// The report page as a whole: names, theme, navigation, keyboard, nothing fetched.
import assert from 'node:assert/strict';
import {everyView, inPage, laptop, pageTest, reports} from './harness.mjs';

for (const name of reports) {
  pageTest('names stay text, ids and links hold, the command line is there', name, ({page}) => inPage(page, ({check, equal, all, data}) => {
    const sections = all(document, 'section.object');
    equal(sections.length, data.objects.length, 'sections');
    data.objects.forEach((object, i) => {
      equal(sections[i].querySelector('h2').textContent, object.name, 'name as text');
      const parts = all(sections[i], '.object-bar nav a').map((link) => document.getElementById(link.hash.slice(1)));
      check(parts.length > 0 && parts.every((part) => sections[i].contains(part)), 'links to the parts of an object');
      equal(Boolean(sections[i].querySelector('.gallery')), object.pictures.length > 0, 'gallery');
      equal(Boolean(sections[i].querySelector('.light-use')), object.rigs.some((rig) => rig.lights.length), 'table of lights');
    });
    check(document.title.startsWith('Rigel report: '), `title: ${document.title}`);
    equal(document.querySelector('.command code').textContent, data.command, 'command line');
    check(all(document, 'button').every((node) => node.textContent.trim() || node.getAttribute('aria-label')), 'a button without a name');
    const ids = all(document, '[id]').map((node) => node.id);
    equal(new Set(ids).size, ids.length, 'unique ids');
    check(all(document, 'nav a').every((link) => document.getElementById(link.hash.slice(1))), 'a link of the navigation leads nowhere');
  }));
}

pageTest('the theme is the system\'s until the reader chooses', 'made-up', async ({page, view}) => {
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const system = await background();
  await page.locator('#theme').click();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), view.theme === 'dark' ? 'light' : 'dark');
  assert.notEqual(await background(), system);
  await page.locator('#theme').click();
  assert.equal(await background(), system);
});

pageTest('the reader\'s theme outlives the page', 'made-up', async ({page, view}) => {
  await page.locator('#theme').click();
  await page.reload();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), view.theme === 'dark' ? 'light' : 'dark');
}, {views: [laptop]});

pageTest('Tab walks through everything in the order it is read, and each stop is seen', 'smallest', async ({page}) => {
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.className), 'skip');
  const stops = await page.evaluate(() => [...document.querySelectorAll('a[href], button, input, summary, [tabindex="0"]')]
    .filter((node) => node.getClientRects().length && !node.disabled && node.tabIndex >= 0).length);
  let below = -Infinity;
  for (let i = 1; i < stops; ++i) {
    await page.keyboard.press('Tab');
    const {top, ring, what} = await page.evaluate(() => {
      const node = document.activeElement;
      const style = getComputedStyle(node);
      return {top: node.getBoundingClientRect().top + scrollY, ring: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2, what: node.outerHTML.slice(0, 80)};
    });
    assert.ok(ring, `no ring around ${what}`);
    assert.ok(top > below - 400, `${what} comes after what stands far below it`);
    below = Math.max(below, top);
  }
});

pageTest('landmarks and headings', 'made-up', ({page}) => inPage(page, ({check, equal, all}) => {
  equal(all(document, 'main').length, 1, 'main');
  equal(all(document, 'h1').length, 1, 'h1');
  check(all(document, 'nav').every((nav) => nav.getAttribute('aria-label')), 'every navigation has a name');
  const levels = all(document, 'h1, h2, h3, h4').map((heading) => Number(heading.tagName[1]));
  check(levels.every((level, i) => !i || level <= levels[i - 1] + 1), `no level of headings is left out: ${levels.join()}`);
  check(all(document, '.scroller').every((box) => box.tabIndex === 0 && box.getAttribute('aria-label')), 'what scrolls can be reached and has a name');
}), {views: [laptop]});

for (const view of everyView) {
  pageTest('text has the contrast that WCAG AA asks for', 'made-up', ({page}) => inPage(page, ({check, all}) => {
    // Colours as the browser draws them; what is over pictures has a ground of its own.
    const canvas = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
    const parsed = (color) => {
      canvas.clearRect(0, 0, 1, 1);
      canvas.fillStyle = color;
      canvas.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
      return {rgb: [r, g, b], alpha: a / 255};
    };
    const mixed = (over, under) => over.rgb.map((value, i) => value * over.alpha + under[i] * (1 - over.alpha));
    const ground = (node) => {
      if (!node) return [255, 255, 255];
      const own = parsed(getComputedStyle(node).backgroundColor);
      return own.alpha === 1 ? own.rgb : mixed(own, ground(node.parentElement));
    };
    const luminance = (rgb) => {
      const [r, g, b] = rgb.map((value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const poor = new Map();
    for (const node of all(document.body, '*')) {
      if (!node.getClientRects().length || node.closest('.stage, [aria-hidden="true"], option, script')) continue;
      if (![...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim())) continue;
      const style = getComputedStyle(node);
      const svg = node instanceof SVGElement;
      const back = ground(svg ? node.closest('svg').parentElement : node);
      const color = parsed(svg ? style.fill : style.color);
      let opacity = 1;
      for (let at = node; at; at = at.parentElement) opacity *= Number(getComputedStyle(at).opacity);
      const [a, b] = [luminance(mixed({...color, alpha: color.alpha * opacity}, back)), luminance(back)].sort((x, y) => y - x);
      const ratio = (a + 0.05) / (b + 0.05);
      if (ratio < 4.5) poor.set(`${node.tagName}.${node.getAttribute('class')}`, `${ratio.toFixed(2)} for "${node.textContent.slice(0, 30)}"`);
    }
    check(!poor.size, `too little contrast: ${[...poor].slice(0, 8).map((entry) => entry.join(' ')).join('; ')}`);
  }), {views: [view]});
}

pageTest('printed, nothing is cut off at the right', 'made-up', ({page}) => page.emulateMedia({media: 'print'}), {views: [{...laptop, width: 1060}]});

pageTest('the bar of an object shows which part is being read', 'made-up', async ({page}) => {
  const last = page.locator('.object-bar nav').first().locator('a').last();
  await page.evaluate((id) => document.getElementById(id).scrollIntoView({behavior: 'instant'}), (await last.getAttribute('href')).slice(1));
  await page.locator('.object-bar nav').first().locator('a[aria-current]').getByText(await last.textContent(), {exact: true}).waitFor();
  const [link, bar] = [await last.boundingBox(), await page.locator('.object-bar nav').first().boundingBox()];
  assert.ok(link.x >= bar.x - 1 && link.x + link.width <= bar.x + bar.width + 1, `link at ${link.x}, bar from ${bar.x} to ${bar.x + bar.width}`);
});
