// The two charts of an object: error over time, and error against cost.
import {inPage, pageTest, reports} from './harness.mjs';

for (const name of reports) {
  pageTest('the charts follow their buttons, the pointer and the keyboard', name, ({page}) => inPage(page, ({check, equal, all, press, pointer, button, data}) => {
    const checkTimeChart = (section, object) => {
      const place = section.querySelector('.plot[tabindex]');
      const lines = () => all(place, '.line');
      equal(lines().length, object.rigs.length, 'lines');
      const first = all(section, '.legend button')[0];
      first.click();
      equal(lines().length, object.rigs.length - 1, 'lines without the first rig');
      equal(first.getAttribute('aria-pressed'), 'false', 'legend');
      first.click();
      const shape = lines()[0].getAttribute('points');
      check(!/NaN|Infinity/.test(place.innerHTML), 'a coordinate of the chart is no number');
      button(section, 'Scale', 'Linear').click();
      check(lines()[0].getAttribute('points') !== shape, 'linear looks like logarithmic');
      button(section, 'Error', 'Spatial').click();
      check(place.textContent.includes('spatial RMS'), 'axis title follows the error');
      button(section, 'Error', 'Total').click();
      button(section, 'Scale', 'Log').click();
      press(place, 'End');
      const last = object.truth[object.truth.length - 1];
      check(place.querySelector('.readout').textContent.includes(`${last.time.toFixed(2)} s`), 'read-out at the last frame');
      press(place, 'Escape');
      check(place.querySelector('.readout').hidden, 'Escape hides the read-out');
      pointer(place, 'pointermove', place.getBoundingClientRect().left + 60);
      const chosen = object.rigs.find((rig) => rig.spec === section.querySelector('tr.chosen .pick')?.textContent);
      const chooses = (rig) => rig.frames.some((frame) => frame.near.length || frame.sh_vectors !== rig.frames[0].sh_vectors);
      const estimates = chosen?.frames.every((frame) => typeof frame.total_estimate === 'number');
      equal(all(place.querySelector('.readout'), '.entry').length, object.rigs.length + 2 + (estimates ? 1 : 0) + (chosen && chooses(chosen) ? 1 : 0), 'lines of the read-out');
      equal(all(place, '.estimate').length, estimates ? 1 : 0, 'estimate of the chosen rig');
      equal(all(place, '.vectors-line').length, object.rigs.filter(chooses).length, 'SH vectors of the rigs that choose');
      equal(all(place, '.near-line').length, object.rigs.filter(chooses).length, 'near lights of the rigs that choose');
      pointer(place, 'pointerleave', 0);
    };
    const checkCostChart = (section, object) => {
      const points = () => all(section, '.point');
      const at = (i) => points()[i].querySelector('.target').getAttribute('cx');
      const before = at(object.rigs.length - 1);
      const group = points()[0].closest('.card');
      button(group, 'Cost', 'Fit').click();
      check(at(object.rigs.length - 1) !== before, 'the cost axis does nothing');
      check(!/NaN|Infinity/.test(group.innerHTML), 'a coordinate of the cost chart is no number');
      press(points()[0], 'Enter');
      equal(section.querySelector('tr.chosen .pick').textContent, object.rigs[0].spec, 'a point chooses its rig');
      button(group, 'Cost', 'Modelled').click();
    };

    const sections = all(document, 'section.object');
    equal(sections.length, data.objects.length, 'sections');
    data.objects.forEach((object, i) => {
      equal(Boolean(sections[i].querySelector('.plot[tabindex]')), object.truth.length > 1, 'time chart');
      if (object.truth.length > 1) checkTimeChart(sections[i], object);
      equal(all(sections[i], '.point').length, object.rigs.length > 1 ? object.rigs.length : 0, 'points');
      if (object.rigs.length > 1) checkCostChart(sections[i], object);
    });
  }));
}
