// A harness that passes everything would pass any page: pages with planted faults must fail, each for its own reason.
import assert from 'node:assert/strict';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import test, {after} from 'node:test';
import {fileOf, inPage, phone, visit} from './harness.mjs';

const folder = mkdtempSync(path.join(tmpdir(), 'rigel-page-'));
after(() => rmSync(folder, {recursive: true}));
const page = readFileSync(fileOf('made-up'), 'utf8');

/** The page with a fault must be refused, and for this reason. */
function planted(fault, reason, faulty, {visitor = () => {}, ...options} = {}) {
  test(`noticed: ${fault}`, async () => {
    assert.notEqual(faulty, page, 'nothing was planted');
    const file = path.join(folder, `${fault.replaceAll(' ', '-')}.html`);
    writeFileSync(file, faulty);
    await assert.rejects(visit(file, options, visitor), reason);
  });
}

planted('an error on the console', /console: planted/, `${page}<script>console.error("planted")</script>`);
planted('an exception', /exception: planted/, `${page}<script>setTimeout(() => { throw new Error("planted"); })</script>`);
planted('a picture that is not embedded', /missing\.png/, `${page}<img src="missing.png">`);
planted('a request that the content policy refuses', /https:\/\/example\.com/, `${page}<script>fetch("https://example.com/").catch(() => {})</script>`);
planted('a script that stops half-way', /exception: /, page.replace('\nconst report = ', '\nconst report = null; const unused = '));
planted('a page wider than a telephone', /wider than its window/, `${page}<div style="width: 600px">planted</div>`, {view: phone});
planted('a check that fails', /the planted check/, `${page}<p>`, {visitor: ({page: opened}) => inPage(opened, ({check}) => check(false, 'the planted check'))});
planted('a script without checks', /nothing was checked/, `${page}<p>`, {visitor: ({page: opened}) => inPage(opened, () => {})});
