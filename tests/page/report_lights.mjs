// The table of lights under the rig chosen.
import {inPage, pageTest, reports} from './harness.mjs';

for (const name of reports) {
  pageTest('the lights of the rig chosen: sorted, with reason and course', name, ({page}) => inPage(page, ({check, equal, all, button, data}) => {
    const checkObject = (section, object) => {
      const card = section.querySelector('.light-use').closest('.card');
      const rows = () => all(card, 'tbody tr');
      const nameOf = (row) => row.querySelector('.name').firstChild.textContent;
      const names = () => rows().map(nameOf).join('|');
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
      equal(nameOf(rows()[0]), sorted((light) => light.near_frames, -1)[0].name, 'sorted by frames near');
      for (const row of rows()) {
        const light = lights.find((candidate) => candidate.name === nameOf(row));
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
      const search = card.querySelector('.search');
      equal(Boolean(search), lights.length > 20, 'search where there are many');
      if (search) {
        const wanted = lights[lights.length - 1].name;
        search.value = wanted.toUpperCase();
        search.dispatchEvent(new Event('input'));
        check(rows().length < lights.length && names().split('|').includes(wanted), 'search finds a light');
        search.value = 'no such light';
        search.dispatchEvent(new Event('input'));
        check(rows()[0].textContent.startsWith('No light'), 'nothing found');
        search.value = '';
        search.dispatchEvent(new Event('input'));
      }
      if (!more.hidden) more.click();
      equal(rows().length, Math.min(20, lights.length), 'first lights again');
    };

    const sections = all(document, 'section.object');
    equal(sections.length, data.objects.length, 'sections');
    data.objects.forEach((object, i) => {
      if (sections[i].querySelector('.light-use')) checkObject(sections[i], object);
    });
  }));
}
