// What belongs to a whole scene: the time that objects share, and disk lights.
import {inPage, laptop, pageTest, reports} from './harness.mjs';

const views = [laptop];

for (const name of reports) {
  pageTest('a card for each budget that objects share, with a row for each of them', name, ({page}) => inPage(page, ({check, equal, all, data}) => {
    const expected = data.scenes.flatMap((scene, i) => scene.budgets.map((budget) => ({budget,
      sharing: data.objects.filter((object) => object.scene_index === i && object.rigs.some((rig) => rig.spec === budget.spec && rig.budget?.alone))})))
      .filter(({sharing}) => sharing.length);
    const cards = all(document, '.budget');
    equal(cards.length, expected.length, 'budgets');
    for (const [i, {budget, sharing}] of expected.entries()) {
      check(cards[i].querySelector('.facts').textContent.includes(budget.spec), 'rig of the budget');
      equal(cards[i].textContent.includes('too long in'), budget.frames_over > 0, 'frames over the budget');
      equal(all(cards[i], 'tbody .name').map((name) => name.textContent).join('|'), sharing.map(({name}) => name).join('|'), 'objects that share');
      const losers = sharing.filter((object) => object.rigs.find((rig) => rig.spec === budget.spec).budget.gave_up).length;
      equal(cards[i].querySelector('.verdict').textContent.startsWith(`${losers} of ${sharing.length} object`), losers > 0, 'how many give something up');
      for (const [row, object] of sharing.entries()) {
        const {budget: use} = object.rigs.find((rig) => rig.spec === budget.spec);
        const cells = all(all(cards[i], 'tbody tr')[row], '.alone').map((cell) => cell.textContent);
        equal(cells.length, 5, 'figures alone');
        if (use.gave_up) check(cells[2].startsWith('alone '), `total error alone of ${object.name}`);
      }
    }
  }), {views});

  pageTest('a card for each scene with disk lights: each method, each disk with its reason', name, ({page}) => inPage(page, ({equal, all, data}) => {
    const scenes = data.scenes.filter((scene) => scene.disks);
    const cards = all(document, 'section.disks');
    equal(cards.length, scenes.length, 'scenes with disks');
    for (const [i, {disks}] of scenes.entries()) {
      const methods = all(cards[i], '.disk-methods tbody tr');
      equal(methods.map((row) => row.querySelector('.name').firstChild.textContent).join('|'), disks.methods.map(({method}) => method).join('|'), 'methods');
      equal(methods.map((row) => row.querySelector('td').textContent === '–').join('|'), disks.methods.map(({sh}) => sh === null).join('|'), 'a dash where a method has no SH');
      equal(cards[i].querySelector('.verdict').textContent, disks.choice, 'choice');
      const groups = [...new Set(disks.uses.map((use) => `${use.object}, ${use.rig}`))];
      const buttons = all(cards[i], '[aria-label="Rig"] button');
      equal(buttons.length, groups.length > 1 ? groups.length : 0, 'rigs with disks');
      for (const [g, group] of groups.entries()) {
        buttons[g]?.click();
        const uses = disks.uses.filter((use) => `${use.object}, ${use.rig}` === group);
        const rows = all(cards[i], '.light-use tbody tr');
        equal(rows.length, uses.length, 'disks');
        for (const row of rows) {
          const use = uses.find(({light}) => light === row.querySelector('.name').textContent);
          equal(all(row, 'td').map((cell) => cell.textContent).join('|'), `${use?.method}|${use?.why}`, 'method and reason');
        }
        equal(rows[0].querySelector('.text').textContent.startsWith('near'), uses.some(({method}) => method.startsWith('near')), 'near disks first');
      }
    }
  }), {views});
}
