// The example of docs/javascript.md prints what stands below it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

test('the example of the page', () => {
  const page = readFileSync(new URL('../../docs/javascript.md', import.meta.url), 'utf8');
  const [, code, rest] = page.match(/```js\n(.*?)```\n\n(.*)/s), expected = rest.match(/^(?: {4}.*\n)+/)[0].replace(/^ {4}/gm, '');
  const program = code.replace("'ovoid'", JSON.stringify(new URL('../../build/wasm/package/ovoid.mjs', import.meta.url).href));
  assert.equal(execFileSync(process.execPath, ['--input-type=module', '-e', program], { encoding: 'utf8' }), expected);
});
