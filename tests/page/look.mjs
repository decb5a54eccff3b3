// Opens any page in four views, fails on what the harness fails on, and writes pictures of it: look.mjs PAGE.html [DIR [SELECTOR]]
// DIR gets laptop-light.png, laptop-dark.png, phone-light.png, phone-dark.png, of the whole page or of the first element
// that SELECTOR names.
import {mkdirSync} from 'node:fs';
import path from 'node:path';
import {closeBrowsers, everyView, visit} from './harness.mjs';

const [file, folder, selector] = process.argv.slice(2);
if (!file) {
  console.error('usage: look.mjs PAGE.html [DIR [SELECTOR]]');
  process.exit(2);
}
if (folder) mkdirSync(folder, {recursive: true});
try {
  for (const view of everyView) {
    await visit(file, {view, webgl: true}, async ({page}) => {
      if (!folder) return;
      const picture = {path: path.join(folder, `${view.name.replace(', ', '-')}.png`)};
      if (selector) await page.locator(selector).first().screenshot(picture);
      else await page.screenshot({...picture, fullPage: true});
    });
  }
} finally {
  await closeBrowsers();
}
