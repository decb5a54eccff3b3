// Opens any page in four views, fails on what the harness fails on, and writes pictures of it: look.mjs PAGE.html [DIR [SELECTOR]]
// DIR gets laptop-light-1.png and so on down the page, then laptop-dark, phone-light, phone-dark; or laptop-light.png and so on
// of the first element that SELECTOR names.
import {mkdirSync} from 'node:fs';
import path from 'node:path';
import {closeBrowsers, everyView, settled, visit} from './harness.mjs';

const kPiece = 1500;  // px; a whole page would be larger than what Chromium draws at once

const [file, folder, selector] = process.argv.slice(2);
if (!file) {
  console.error('usage: look.mjs PAGE.html [DIR [SELECTOR]]');
  process.exit(2);
}
if (folder) mkdirSync(folder, {recursive: true});

async function pictures(page, view) {
  const name = path.join(folder, view.name.replace(', ', '-'));
  if (selector) return page.locator(selector).first().screenshot({path: `${name}.png`});
  await page.setViewportSize({width: view.width, height: kPiece});
  await settled(page);
  const height = await page.evaluate(() => document.documentElement.scrollHeight);
  for (let i = 0; i * kPiece < height; ++i) {
    await page.evaluate((y) => scrollTo({top: y, behavior: 'instant'}), i * (kPiece - 100));
    await settled(page);
    await page.screenshot({path: `${name}-${i + 1}.png`});
  }
}

try {
  for (const view of everyView) {
    await visit(file, {view, webgl: true}, async ({page}) => {
      if (folder) await pictures(page, view);
    });
  }
} finally {
  await closeBrowsers();
}
