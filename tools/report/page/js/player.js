// The moment shown: a slider over the frames that have pictures, and playback at their own pace.

const kSpeeds = [{value: 0.25, label: '¼×'}, {value: 0.5, label: '½×'}, {value: 1, label: '1×'}];

/** `frames` in the order of time; `ready(index)` resolves once a frame can be shown without waiting. */
function makePlayer(frames, {ready, onFrame}) {
  const last = frames.length - 1;
  let index = 0;
  let playing = null;  // one run of playback; another, or none, ends it
  let speed = 1;
  const range = element('input', {type: 'range', min: 0, max: last, step: 1, value: 0, 'aria-label': 'Frame', on: {input: () => {
    stop();
    onFrame(Number(range.value));
  }}});
  const play = element('button', {type: 'button', class: 'quiet play', on: {click: () => (playing ? stop() : start())}});
  const time = element('output', {class: 'time'});
  const step = (label, name, by) => element('button', {type: 'button', class: 'quiet', 'aria-label': name, title: name, on: {click: () => {
    stop();
    onFrame((index + by + frames.length) % frames.length);
  }}}, label);
  const full = element('button', {type: 'button', class: 'quiet', title: 'The frame whose pictures are stored in full', on: {click: () => {
    stop();
    onFrame(frames.findIndex((frame) => frame.exact));
  }}}, 'Full picture');
  const speeds = choice('Speed', kSpeeds, (value) => {
    speed = value;
    speeds.show(speed);
  });
  speeds.show(speed);
  label();

  function label() {
    play.textContent = playing ? '❚❚ Pause' : '▶ Play';
  }
  function stop() {
    playing = null;
    label();
  }
  /** By the clock: where unpacking or drawing takes longer than a frame lasts, frames are left out. */
  async function start() {
    const run = playing = {};
    label();
    const from = frames[0].time;
    const until = frames[last].time + (frames[last].time - from) / last;
    let at = frames[index].time;
    let before = performance.now();
    while (playing === run) {
      await new Promise(requestAnimationFrame);
      const now = performance.now();
      at += speed * (now - before) / 1000;
      before = now;
      if (at >= until) at = from + (at - until) % (until - from);
      const next = Math.max(0, frames.findLastIndex(({time: begins}) => begins <= at));
      if (next === index) continue;
      await ready(next);
      if (playing === run) onFrame(next);
    }
  }

  // Marks of the frames under the slider, the one in full taller.
  const marks = element('div', {class: 'marks', 'aria-hidden': 'true'}, ...frames.map((frame, i) => {
    const mark = element('span', {class: frame.exact ? 'exact' : null});
    mark.style.left = `${100 * i / Math.max(1, last)}%`;
    return mark;
  }));
  return {
    node: element('div', {class: 'player'}, play, step('‹', 'Frame before', -1), element('div', {class: 'track'}, range, marks), step('›', 'Next frame', 1), time,
      frames.some((frame) => frame.exact) && frames.some((frame) => !frame.exact) ? full : null, speeds.node),
    isPlaying: () => playing !== null,
    stop,
    show(shown) {
      index = shown;
      range.value = index;
      const {frame, time: at} = frames[index];
      const text = `${seconds(at)}, frame ${frame}`;
      range.setAttribute('aria-valuetext', text);
      time.textContent = text;
      full.disabled = frames[index].exact;
    },
  };
}
