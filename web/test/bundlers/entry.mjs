// The program that each bundler bundles: a known distance and its proof.
import { load, Status } from 'ovoid';

const { Shape, distance, verify } = await load();
const box = Shape.box([1, 1, 1]), ball = Shape.sphere(0.5), answer = distance(box, ball, null, { xyz: [3, 0, 0] });
const said = `${answer.status === Status.separated} ${Math.abs(answer.lower - 1.5) < 1e-9} ${verify(box, ball, null, { xyz: [3, 0, 0] }, answer)}`;
console.log(said);
if (globalThis.document) document.title = said;
