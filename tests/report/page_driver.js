// What scripts that drive a page have in common. check_page.sh puts it before each of them, in one <script>: a script calls
// `check` and `equal` as it goes and hands `drive` the function that does it all, which writes the outcome into
// <body data-check>.
'use strict';
let checks = 0;
const failures = [];
const check = (passed, what) => {
  ++checks;
  if (!passed) failures.push(what);
};
const equal = (actual, expected, what) => check(actual === expected, `${what}: ${actual}, not ${expected}`);
addEventListener('error', (event) => failures.push(`exception: ${event.message}`));
addEventListener('unhandledrejection', (event) => failures.push(`rejection: ${event.reason}`));

const press = (node, key) => node.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true}));
const drawn = () => new Promise((done) => setTimeout(done, 1000));  // of virtual time: charts wait for a frame

const drive = (run) => run().catch((error) => failures.push(`exception: ${error.message}`)).finally(() => {
  const outcome = failures.length ? `failed: ${failures.join('; ')}` : `ok, ${checks} checks`;
  document.body.dataset.check = outcome;
  if (parent !== window) parent.postMessage(outcome, '*');  // framed, to make the window as narrow as a telephone
});
