// The table of all rigs of an object.
import {inPage, pageTest, reports} from './harness.mjs';

for (const name of reports) {
  pageTest('the table of rigs sorts, marks the front and keeps the focus', name, ({page}) => inPage(page, ({check, equal, all, data}) => {
    const checkObject = (section, object) => {
      const order = () => all(section, '.rigs .pick').map((pick) => pick.textContent).join('|');
      const sort = (title) => all(section, '.sort').find((candidate) => candidate.textContent.startsWith(title));
      const rigNamed = (spec) => object.rigs.find((rig) => rig.spec === spec);
      const rises = (sign) => order().split('|').map((spec) => sign * rigNamed(spec).total.rms).every((value, i, values) => !i || values[i - 1] <= value);
      equal(order(), object.rigs.map((rig) => rig.spec).join('|'), 'order of the command line');
      sort('Total RMS').click();
      check(rises(1), `sorted by total error: ${order()}`);
      equal(sort('Total RMS').closest('th').getAttribute('aria-sort'), 'ascending', 'aria-sort');
      sort('Total RMS').click();
      check(rises(-1), `sorted downwards: ${order()}`);
      const cost = data.objects.some(({rigs}) => rigs.some((rig) => rig.near_lights > 0)) ? 'modelled_ns_per_point' : 'bytes';
      const beaten = (rig) => object.rigs.some((other) => other !== rig && other[cost] <= rig[cost] && other.total.rms <= rig.total.rms &&
        (other[cost] < rig[cost] || other.total.rms < rig.total.rms));
      for (const row of all(section, '.rigs tbody tr')) {
        const rig = rigNamed(row.querySelector('.pick').textContent);
        equal(row.classList.contains('pareto'), !beaten(rig), `Pareto mark of ${rig.spec}`);
      }
      const pick = all(section, '.pick')[0];
      pick.focus();
      pick.click();
      check(document.activeElement === pick, 'choosing a rig loses the focus');
    };

    const sections = all(document, 'section.object');
    equal(sections.length, data.objects.length, 'sections');
    data.objects.forEach((object, i) => {
      if (true) checkObject(sections[i], object);
    });
  }));
}
