// The report page as a whole: names, theme, navigation, keyboard, nothing fetched.
import assert from 'node:assert/strict';
import {everyView, inPage, pageTest, reports} from './harness.mjs';

for (const name of reports) {
  pageTest('names stay text, ids and links hold, the command line is there', name, ({page}) => inPage(page, ({check, equal, all, data}) => {
    const sections = all(document, 'section.object');
    equal(sections.length, data.objects.length, 'sections');
    data.objects.forEach((object, i) => {
      equal(sections[i].querySelector('h2').textContent, object.name, 'name as text');
      equal(Boolean(sections[i].querySelector('.gallery')), object.pictures.length > 0, 'gallery');
      equal(Boolean(sections[i].querySelector('.light-use')), object.rigs.some((rig) => rig.lights.length), 'table of lights');
    });
    check(document.title.startsWith('Rigel report: '), `title: ${document.title}`);
    equal(document.querySelector('footer code').textContent, data.command, 'command line');
    check(all(document, 'button').every((node) => node.textContent.trim() || node.getAttribute('aria-label')), 'a button without a name');
    const ids = all(document, '[id]').map((node) => node.id);
    equal(new Set(ids).size, ids.length, 'unique ids');
    check(all(document, 'nav a').every((link) => document.getElementById(link.hash.slice(1))), 'a link of the navigation leads nowhere');
  }), {views: everyView});
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
