// Rig and truth in turn, at a rate that no one need fear.

const kSlowest = 0.5;
const kFastest = 6;  // changes a second: three flashes, the most that WCAG 2.3.1 allows

/** Turns from rig to truth and back. With reduced motion asked for it waits for the button. */
function makeFlicker(draw) {
  let truth = false;
  let timer = null;
  let isOn = false;
  let rate = 2;
  const still = matchMedia('(prefers-reduced-motion: reduce)');
  let held = still.matches;
  const rateKnob = knob('Rate', {min: kSlowest, max: kFastest, step: 0.5, value: rate}, (value) => {
    rate = value;
    update();
  }, (value) => `${value} a second`);
  const swap = element('button', {type: 'button', class: 'quiet', on: {click: () => {
    held = true;
    turn();
    update();
  }}}, 'Swap');
  const hold = element('button', {type: 'button', class: 'quiet', on: {click: () => {
    held = !held;
    update();
  }}});
  const node = element('div', {class: 'flicker'}, hold, swap, rateKnob.node);
  function turn() {
    truth = !truth;
    draw();
  }
  function update() {
    clearInterval(timer);
    rateKnob.show(rate);
    hold.textContent = held ? '▶ Run' : '❚❚ Hold';
    node.hidden = !isOn;
    if (isOn && !held) timer = setInterval(turn, 1000 / rate);
  }
  update();
  return {
    node,
    showsTruth: () => truth,
    run(on) {
      if (on === isOn) return;
      isOn = on;
      update();
    },
  };
}
