// After the objects: the lights, what was left out, what the numbers mean, how the report was made.

function sceneNotes(scene) {
  const card = element('section', {class: 'card'}, element('h2', {}, sceneTitle(scene)),
    element('p', {class: 'facts'}, [plural(scene.frames, 'frame'), scene.effects.length ? `effects: ${scene.effects.join(', ')}` : null,
      `measured in ${figure(scene.seconds)} s`].filter(Boolean).join(' · ')));
  if (scene.lights.length) {
    card.append(element('h3', {}, plural(scene.lights.length, 'light')),
      element('div', {class: 'scroller tall', tabindex: '0', role: 'region', 'aria-label': `Lights of ${scene.scene}`},
        element('table', {class: 'lights'},
          element('thead', {}, element('tr', {}, ...['Name', 'Type', 'Values'].map((title) => element('th', {scope: 'col'}, title)))),
          element('tbody', {}, ...scene.lights.map((light) => element('tr', {}, element('th', {scope: 'row'}, light.name),
            element('td', {}, light.type), element('td', {}, light.summary)))))));
  }
  if (scene.notes.length) {
    card.append(element('h3', {}, 'What the file holds that Rigel does not use'),
      element('ul', {class: 'notes'}, ...scene.notes.map((note) => element('li', {}, note))));
  }
  return card;
}

function meaning() {
  const terms = [
    ['Relative error', 'Every error is divided by the mean exact irradiance of the object: over its surface samples, the three colour channels and all frames. 5 % is one twentieth of the light an average point receives.'],
    ['Spatial error', 'The rig against spherical harmonics projected afresh at every surface sample, with as many bands. It is what the rig adds by interpolating over the object, and nothing else.'],
    ['Total error', 'What is seen: the irradiance the shader computes, negative values clamped, against exact irradiance with the true shape of every light and its horizon. It includes what the SH bands cannot hold, so it does not fall to zero however many SH vectors a rig has.'],
    ['RMS and max', 'RMS pools all samples, channels and frames; max is the largest single one. Light blocked by other surfaces counts in neither.'],
    ['Causes of an error', 'The error at a point is the sum of steps from exact irradiance to what is shown: near lights in their float form; far lights cut to the bands of SH and clamped at 0 (truncation); the same as the runtime projects lights (light model); the rig instead of SH at the point (spatial); 32 bits (precision). The square of the error is the sum of their squares and of the interaction, twice their products, which is negative where they cancel. “RMS without” a cause: both its square and its products gone.'],
    ['Max jump', 'The largest change, at any sample, of the error from one frame to the next. Movement of the true light does not count, so a high value is light that pops. Only frames that follow on each other are compared: none are skipped between them, and no clip starts over.'],
    ['SH vectors, projections', 'What is stored, and what is computed of every light each frame. A value with its gradient counts as four projections. Rigs named auto take as many SH vectors as a frame needs: their figure is the mean over the frames.'],
    ['Near lights', 'Lights too close for a rig are evaluated exactly at every point. A light becomes near gradually: the share w is evaluated, 1 − w stays in the rig. Spatial error concerns what is left in the rig, total error all of it.'],
    ...(report.objects.some(({pictures}) => pictures.some(({flip}) => flip !== undefined)) ? [['FLIP', 'How large the difference of two pictures looks to someone who flips between them: 0 is not seen, 1 the largest there is (Andersson and others 2020). Of the pictures as they are shown, for a 0.7 m wide screen of 3840 pixels seen from 0.7 m; mean over the pixels of the object.']] : []),
    ['Estimate', 'The spatial RMS as the rig itself takes it to be, from its own samples and without knowing the truth. It is what rigs aim with that are given a target.'],
    ['Bound', 'A light left in the rig is wrong by no more than this anywhere on the object, relative to the mean light. It is certain and therefore often far above the error itself.'],
    ['Budget', 'Under --budget-us all objects of a frame share its time. Each gets the error it aims at (a total error of 2 %, unless another was named) while there is time for it; then all who must give up are allowed the same error, as small as the time permits. Alone: the same rig with the whole time to itself.'],
    ['Fit, shade', `Fit: the median time of what has to be done once a frame: refresh, bound, choose, project, fit. Shade: the time to evaluate rig and near lights at one surface point. ${report.device ? `Fit on the processor, shading on the device (${report.device})` : 'Both on the processor of this run'}: compare them with each other, not with other machines. Modelled: the same by a cost model, which choices go by so that they do not depend on load.`],
    ...(report.device ? [['Half floats', 'Coefficients stored in 16 bits, with a scale for each rig, take half the memory. What they add is a cause of error of its own: the RMS of the change in the rig’s irradiance, measured on the device beside the same in 32 bits.']] : []),
    ['Pareto-optimal', 'No other rig measured here has both less error and less cost.'],
    ['Advised', `The rig with the fewest SH vectors (where lights are near: the least modelled time) whose total RMS is within ${percent(report.verdict_slack)} of the least. Where even the least is above ${percent(report.usable_error)}, none is advised.`],
  ];
  return element('section', {class: 'card', id: 'meaning'}, element('h2', {}, 'What the numbers mean'),
    element('dl', {class: 'terms'}, ...terms.map(([term, text]) => element('div', {}, element('dt', {}, term), element('dd', {}, text)))));
}

function colophon() {
  return element('footer', {}, element('p', {}, `Made by rigel ${report.version}. The same figures for programs: report.json, beside this page.`));
}
