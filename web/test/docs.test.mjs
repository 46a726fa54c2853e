// The example of docs/javascript.md and of the package's README prints what stands below it, and the README's links lead somewhere.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const packed = new URL('../../build/wasm/package/', import.meta.url), readme = new URL('README.md', packed);

for (const file of [new URL('../../docs/javascript.md', import.meta.url), readme])
  test(`the example of ${file.pathname.split('/').pop()}`, () => {
    const page = readFileSync(file, 'utf8'), [, code, rest] = page.match(/```js\n(.*?)```\n\n(.*)/s);
    const expected = rest.match(/^(?: {4}.*\n)+/)[0].replace(/^ {4}/gm, ''), program = code.replace("'ovoid'", JSON.stringify(new URL('node.mjs', packed).href));
    assert.equal(execFileSync(process.execPath, ['--input-type=module', '-e', program], { encoding: 'utf8' }), expected);
  });

// Of npm's page there is no folder beside it: a link is a heading of the page or an address.
test("the links of npm's page", () => {
  const page = readFileSync(readme, 'utf8'), links = [...page.matchAll(/\]\(([^)]*)\)/g)].map(([, to]) => to);
  const headings = [...page.matchAll(/^#+ (.*)$/gm)].map(([, title]) => `#${title.toLowerCase().replace(/[^\w -]/g, '').replaceAll(' ', '-')}`);
  assert.ok(links.length >= 8);
  for (const link of links) assert.ok(headings.includes(link) || link.startsWith('https://'), link);
});
