// What each kind of page shows at once: all bodies at all times, names that hide nothing, one bracket for one pair, motion between frames.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { alter, browser, flat, folder, inStart, land, open, run, skip, startArm } from './browser.mjs';

const write = (name, text) => writeFileSync(join(folder, name), typeof text === 'string' ? text : JSON.stringify(text));
const at = (page, call, argument) => page.evaluate(call, argument);

/** The page as a phone has it, and drawn so. */
async function makePhone(page) {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.waitForFunction(() => window.ovoidPage.view.renderer.domElement.width === document.getElementById('stage').clientWidth && innerWidth === 390);
  await land(page);
}

/** How far the bodies' hulls are outside the picture: 0 where all are in it, in halves of it. */
const measureOutside = (page) => at(page, () => {
  const { view, model } = window.ovoidPage, point = view.camera.position.clone();
  view.camera.updateMatrixWorld();
  return model.listBalls().reduce((most, { center }) => {
    point.set(...center).project(view.camera);
    return Math.max(most, Math.abs(point.x) - 1, Math.abs(point.y) - 1);
  }, 0);
});

test('a robot is in the picture in all of its states, and all bodies of a motion at all times', { skip }, async () => {
  run('robot', 'path', ...startArm, '--states', inStart('straight.csv'), '--html', 'all-path.html');
  write('round.csv', 'shoulder,elbow\n0,0\n-2.9,0\n');
  run('robot', 'check', ...startArm, '--states', 'round.csv', '--html', 'all-states.html');
  write('go.json', { objects: [{ name: 'wall', box: [0.2, 4, 4] }, { name: 'ball', sphere: 0.5, pose: { xyz: [4, 0, 0] } }] });
  write('far.csv', 'time,body,x,y,z,qw,qx,qy,qz\n0,ball,4,0,0,1,0,0,0\n1,ball,40,0,0,1,0,0,0\n');
  run('run', 'go.json', '--motion', 'far.csv', '--html', 'all-run.html', '-o', 'all-run.csv');
  for (const [file, track, places] of [['all-path.html', 'track', [0, 0.3, 0.7, 1]], ['all-states.html', 'track', [0, 1]], ['all-run.html', 'timeline', [0, 1]]]) {
    const { page, errors } = await open(file, flat);
    await land(page);
    for (const place of places) {
      await at(page, ([name, to]) => window.ovoidPage[name].set(to), [track, place]);
      assert.equal(await measureOutside(page), 0, `${file} at ${place}`);
    }
    assert.deepEqual(errors, []);
    await page.close();
  }
});

test('of a motion the headline begins with what is near from the beginning; between frames it goes as the tool took it', { skip }, async () => {
  run('run', inStart('assembly.json'), '--motion', inStart('motion.csv'), '--margin', '2', '--continuous', '--html', 'between.html', '-o', 'between.csv');
  const { page, errors } = await open('between.html', flat);
  assert.equal(await page.textContent('#headline'), '3 pairs are within 2 mm from the beginning; then wedge and motor come within 2 mm at t = 0.139, proven. Deepest: wedge and motor overlap by 22.8 mm, proven, at t = 1.');
  assert.deepEqual(await page.$$eval('thead th', (cells) => cells.map((cell) => cell.textContent)), ['pair', 'now, mm', 'least, mm', 'at t']);
  const { from, time } = await at(page, () => window.ovoidPage.timeline.motion.events.find(({ kind }) => kind === 'impact'));
  const ask = (t) => at(page, (place) => {
    const { timeline, model } = window.ovoidPage;
    timeline.set(place);
    return model.pairs.find(({ a, b }) => a.name === 'wedge' && b.name === 'motor').now;
  }, t);
  assert.ok((await ask(from)).upper > 2 && (await ask(time)).lower <= 2, `the margin is passed between ${from} and ${time}`);
  await page.focus('#time');
  await at(page, () => window.ovoidPage.timeline.set(0.5));
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.textContent('#now'), 't = 0.51');
  // Half of a turn about an axis, the shorter way round.
  const half = await at(page, () => {
    const { timeline, model: { bodies } } = window.ovoidPage, { motion } = timeline, wedge = bodies.find(({ name }) => name === 'wedge'), at = 7 * wedge.index;
    motion.poses.set([1, 0, 0, 0], at + 3);
    motion.poses.set([-1.2, 0, 0, -1.6], at + 7 * bodies.length + 3);
    return timeline.poseAt(wedge, 0.5).quat_wxyz;
  });
  half.forEach((x, i) => assert.ok(Math.abs(x - [2, 0, 0, 1][i] / Math.sqrt(5)) < 1e-15, `${half}`));
  assert.deepEqual(errors, []);
  await page.close();
});

test('a plot over frames has them at their times, and the slider goes from frame to frame', { skip }, async () => {
  write('uneven.csv', 'time,body,x,y,z,qw,qx,qy,qz\n0,ball,4,0,0,1,0,0,0\n1,ball,3,0,0,1,0,0,0\n10,ball,2,0,0,1,0,0,0\n');
  run('run', 'go.json', '--motion', 'uneven.csv', '--html', 'uneven.html', '-o', 'uneven.out');
  const { page, errors } = await open('uneven.html', flat), read = () => at(page, () => [window.ovoidPage.timeline.frame, window.ovoidPage.timeline.cursor.getAttribute('transform')]);
  await page.focus('#time');
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await read(), [1, 'translate(60 0)']);
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  assert.deepEqual(await read(), [2, 'translate(600 0)']);
  assert.equal(await page.$eval('.curve', (curve) => curve.getAttribute('points').split(' ')[1].split(',')[0]), '60');
  assert.deepEqual(await page.$$eval('.scale span', (ends) => ends.map((end) => parseFloat(end.textContent))), [3.4, 0]);
  assert.deepEqual(errors, []);
  await page.close();
});

test('of one pair all is shown at once; where nothing is near, a sentence says so', { skip }, async () => {
  write('one.json', { unit: 'm', objects: [{ name: 'a', sphere: 1 }, { name: 'b', sphere: 1, pose: { xyz: [3, 0, 0] } }] });
  run('check', 'one.json', '--html', 'one.html');
  const single = await open('one.html', flat);
  assert.deepEqual(await Promise.all(['#list', '#filters', '#proofs', '#check'].map((id) => single.page.isVisible(id))), [false, false, false, true]);
  await single.page.click('#check');
  assert.equal(await single.page.textContent('#proof'), 'The proof holds.');
  await at(single.page, () => window.ovoidPage.chooseBody(window.ovoidPage.model.bodies[0]));
  await single.page.keyboard.press('Escape');
  assert.equal(await single.page.textContent('#status'), 'They are 1 m apart, proven.');
  run('robot', 'check', ...startArm, '--state', 'shoulder=0,elbow=0', '--html', 'free.html');
  const free = await open('free.html', flat);
  assert.equal(await free.page.textContent('#more'), 'All are farther apart than 0.2 m.');
  assert.equal(await free.page.textContent('#verdict'), 'This state: free; all are farther apart than 0.2 m');
  write('lonely.json', { objects: [{ name: 'lonely', box: [1, 1, 1] }] });
  run('check', 'lonely.json', '--html', 'lonely.html');
  const lonely = await open('lonely.html', flat);
  assert.deepEqual([await lonely.page.textContent('#summary'), await lonely.page.$$eval('#layer-witness', (boxes) => boxes.length)], ['1 body', 0]);
  for (const { page, errors } of [single, free, lonely]) {
    assert.deepEqual(errors, []);
    await page.close();
  }
});

test('names stand beside small bodies, and among many only where there is room; no text is cut', { skip }, async () => {
  const balls = Array.from({ length: 300 }, (_, i) => ({ name: `ball number ${i}`, sphere: 0.4, pose: { xyz: [i % 20, Math.floor(i / 20), 0] } }));
  write('small.json', { unit: 'm', objects: balls.filter((_, i) => i % 60 === 0).map((ball) => ({ ...ball, sphere: 0.2 })) });
  write('lots.json', { unit: 'm', objects: balls });
  run('check', 'small.json', '--html', 'small.html');
  run('check', 'lots.json', '--margin', '0.3', '--html', 'lots.html');
  const small = await open('small.html', flat), lots = await open('lots.html', flat);
  await makePhone(small.page);
  const covered = await at(small.page, () => {
    const { view, model } = window.ovoidPage, box = view.canvas.getBoundingClientRect();
    const names = [...document.querySelectorAll('#labels .label:not(.distance)')].map((label) => label.getBoundingClientRect());
    return [names.length, model.bodies.filter(({ center }) => {
      const p = view.camera.position.clone().set(...center).project(view.camera), x = box.left + ((p.x + 1) / 2) * box.width, y = box.top + ((1 - p.y) / 2) * box.height;
      return names.some((name) => name.left < x && x < name.right && name.top < y && y < name.bottom);
    }).length];
  });
  assert.ok(covered[0] >= 3, `${covered[0]} names`);
  assert.equal(covered[1], 0, 'names cover what they name');
  await land(lots.page);
  const named = await lots.page.$$eval('#labels .label:not(.distance)', (labels) => labels.length);
  assert.ok(named === 1 || named === 2, `${named} names: those of the nearest pair, where they fit`);
  // No label is over the edge.
  run('check', inStart('assembly.json'), '--html', 'edge.html');
  const edge = await open('edge.html', flat);
  await makePhone(edge.page);
  const [right, ...ends] = await edge.page.$$eval('#stage, #labels .label', (nodes) => nodes.map((node) => node.getBoundingClientRect().right));
  assert.ok(ends.length > 3 && ends.every((end) => end <= right), `${ends} of ${right}`);
  // Of a wide bracket both ends are on the label.
  alter('small.html', (data) => Object.assign(data.pairs[0].answer, { status: 'overlapping', lower: -0.00416123, upper: -0.000678123 }));
  const wide = await open('altered.html', flat);
  await land(wide.page);
  assert.equal(await wide.page.textContent('.label.distance'), 'overlap 6.78e-4 to 0.00417 m');
  for (const { page } of [wide, edge]) assert.ok(await page.$$eval('.label', (labels) => labels.every((label) => label.scrollWidth <= label.clientWidth)), 'a text is cut');
  for (const { page, errors } of [small, lots, edge, wide]) {
    assert.deepEqual(errors, []);
    await page.close();
  }
});

test('witness points are as large from near as from far; keys turn the view', { skip }, async () => {
  write('turn.json', { objects: [{ name: 'a', box: [1, 1, 1] }, { name: 'b', box: [1, 1, 1], pose: { xyz: [1.01, 0, 0] } }, { name: 'c', box: [1, 1, 1], pose: { xyz: [30, 0, 0] } }] });
  run('check', 'turn.json', '--html', 'turn.html');
  const { page, errors } = await open('turn.html');
  const measure = () => at(page, () => {
    const { view } = window.ovoidPage, [dot] = view.pairGroup.children;
    view.drawNow();
    return (dot.scale.x * dot.geometry.parameters.radius * view.canvas.clientHeight) / (2 * Math.tan((view.camera.fov * Math.PI) / 360) * dot.position.distanceTo(view.camera.position));
  });
  await land(page);
  const far = await measure();
  await at(page, () => window.ovoidPage.choosePair(window.ovoidPage.panel.matching()[0]));
  await land(page);
  const near = await measure();
  assert.ok(far > 3 && far < 8 && Math.abs(near - far) < 0.01, `${far} pixels, ${near} from near`);
  const look = () => at(page, () => {
    const { camera, controls } = window.ovoidPage.view, from = camera.position.clone().sub(controls.target);
    return [Math.atan2(from.y, from.x), from.z / from.length(), from.length()];
  });
  await page.focus('#canvas');
  assert.notEqual(await at(page, () => getComputedStyle(document.getElementById('canvas')).outlineStyle), 'none');
  for (const [key, part, way] of [['ArrowRight', 0, 1], ['ArrowLeft', 0, -1], ['ArrowUp', 1, 1], ['ArrowDown', 1, -1], ['+', 2, -1], ['-', 2, 1]]) {
    const before = await look();
    await page.keyboard.press(key);
    const after = await look(), changes = after.map((x, i) => x - before[i]);
    assert.ok(way * changes[part] > 0.01, `${key}: ${changes}`);
    assert.ok(changes.every((change, i) => i === part || Math.abs(change) < 1e-6), `${key} alone: ${changes}`);
  }
  assert.deepEqual(errors, []);
  await page.close();
});

test('seven joints have a row each, whole names and numbers; on a phone nothing touches the edge', { skip }, async () => {
  const links = Array.from({ length: 8 }, (_, i) => `<link name="l${i}"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>`).join('');
  const joints = Array.from({ length: 7 }, (_, i) => `<joint name="panda_joint${i + 1}" type="revolute"><parent link="l${i}"/><child link="l${i + 1}"/><origin xyz="0.2 0 0"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>`).join('');
  write('seven.urdf', `<robot name="seven">${links}${joints}</robot>`);
  run('robot', 'check', 'seven.urdf', '--state', `panda_joint1=-1.46738521,panda_joint7=-2.7262`, '--html', 'seven.html');
  const { page, errors } = await open('seven.html', flat);
  const rows = await page.$$eval('.joint', (all) => all.map((row) => [row.querySelector('.name').textContent, row.offsetHeight, [...row.querySelectorAll('.name, .value')].every((node) => node.scrollWidth <= node.clientWidth + 1), row.querySelector('.value').value]));
  rows.forEach(([name, height, isWhole], i) => assert.ok(name === `panda_joint${i + 1}` && height <= 36 && isWhole, `${name}: ${height} pixels high`));
  assert.deepEqual([rows.length, rows[0][3], await at(page, () => window.ovoidPage.joints.q[0])], [7, '-1.4674', -1.46738521]);
  await makePhone(page);
  assert.ok(await page.$$eval('aside > :not(header):not(:empty)', (nodes) => nodes.filter((node) => node.offsetWidth).every((node) => node.getBoundingClientRect().left >= 8)));
  assert.deepEqual(errors, []);
  await page.close();
});

test('a chosen pair is seen through what stands before it', { skip }, async () => {
  const objects = [{ name: 'a', box: [1, 1, 1] }, { name: 'b', box: [1, 1, 1], pose: { xyz: [1.5, 0, 0] } }, { name: 'cover', box: [6, 6, 6] }, { name: 'aside', box: [1, 1, 1], pose: { xyz: [9, 0, 0] } }];
  write('hidden.json', { objects });
  run('check', 'hidden.json', '--html', 'hidden.html');
  for (const where of [browser, flat]) {
    const { page, errors } = await open('hidden.html', where);
    await land(page);
    const look = () => at(page, () => {
      const { view, model } = window.ovoidPage, p = view.camera.position.clone().set(...model.bodies[0].center).project(view.camera), box = view.canvas.getBoundingClientRect();
      return view.bodyAt(box.left + ((p.x + 1) / 2) * box.width, box.top + ((1 - p.y) / 2) * box.height)?.name;
    });
    const count = () => at(page, () => window.ovoidPage.view.layers.meshes.items.filter(({ isShown }) => isShown).map(({ body }) => body.name));
    assert.equal(await look(), 'cover');
    await at(page, () => window.ovoidPage.choosePair(window.ovoidPage.model.pairs.find(({ a, b }) => a.name === 'a' && b.name === 'b')));
    await land(page);
    assert.match(await look(), /^[ab]$/);
    assert.deepEqual(await count(), ['a', 'b']);
    // What is seen through is drawn, and found where nothing else is.
    assert.deepEqual(await at(page, () => window.ovoidPage.view.layers.ghosts.items.filter(({ isShown }) => isShown).map(({ body }) => body.name)), ['cover', 'aside']);
    await page.keyboard.press('x');
    assert.deepEqual(await at(page, () => window.ovoidPage.view.shownLayers.map(({ name }) => name)), ['meshes']);
    await page.keyboard.press('x');
    await page.keyboard.press('Escape');
    await page.keyboard.press('f');
    await land(page);
    assert.equal((await count()).length, 4);
    assert.equal(await look(), 'cover');
    assert.deepEqual(errors, []);
    await page.close();
  }
});

test('contacts are drawn, listed, moved with the bodies and checked; without --contacts there are none', { skip }, async () => {
  run('check', inStart('stack.json'), '--margin', '0.01', '--contacts', '--html', 'contacts.html');
  const { page, errors } = await open('contacts.html', flat);
  const count = () => at(page, () => window.ovoidPage.view.contacts.lines.length);
  // Sides: two of the rod's segment are one; squares of four, three of them; an octagon; a normal of each of the six contacts.
  assert.equal(await count(), 1 + 3 * 4 + 8 + 6);
  await page.click('#pairs tr:nth-child(4)');
  assert.equal(await page.textContent('#status'), 'They are 5e-4 apart, proven.');
  assert.match(await page.textContent('#contacts'), /^by face b, 4 of 8 points: 5e-4, area 0.828427edges/);
  assert.equal(await count(), 8 + 1);
  await page.click('#check');
  assert.equal(await page.textContent('#proof'), 'The proof holds, and that of the contact.');
  await page.click('#layer-contacts');
  assert.equal(await at(page, () => window.ovoidPage.view.contacts.group.visible), false);
  // The lid is lifted beyond the margin, then pressed into the crate.
  const move = (z) => at(page, (to) => {
    const { ovoidPage } = window, body = ovoidPage.model.bodies.find(({ name }) => name === 'lid');
    body.pose.xyz[2] = to;
    ovoidPage.moved(body);
    return ovoidPage.panel.chosen.answer.contacts.map(({ points, upper }) => [points.length, upper]);
  }, z);
  assert.deepEqual(await move(1.2), []);
  assert.equal(await page.textContent('#contacts'), 'No contact within 0.01.');
  const [[points, upper]] = await move(1.024);
  assert.ok(points === 4 && Math.abs(upper + 0.1) < 1e-9);
  assert.deepEqual(errors, []);
  await page.close();
  alter('contacts.html', (data) => (data.pairs[3].answer.contacts[0].points[0].id ^= 1));
  const altered = await open('altered.html', flat);
  await altered.page.click('#check-all');
  await altered.page.waitForFunction(() => /hold/.test(document.getElementById('checked').textContent));
  assert.match(await altered.page.textContent('#checked'), /^1 of 5 proofs do not hold/);
  await altered.page.close();
  run('check', inStart('stack.json'), '--margin', '0.01', '--html', 'plain.html');
  const plain = await open('plain.html', flat);
  assert.equal(await plain.page.$('#layer-contacts'), null);
  await plain.page.close();
});
