// What TypeScript takes of the package, and what it refuses: each refusal stands below the line that expects it.
import { load, OvoidError, Status, type Answer, type AnswerFields } from 'ovoid';

const { Shape, Robot, collide, distance, within, verify, batch, impact } = await load();
const box = Shape.box([1, 1, 1]), same = Shape.box({ size: [2, 2, 2] }), pose = { xyz: [3, 0, 0] as const };
const answer: Answer = distance(box, same, null, pose, { cap: 5, earlier: collide(box, same) });
export const isApart: boolean = answer.status === 'separated' && answer.status === Status.separated && answer.is('separated');
export const isNear: boolean | null = within(box, same, null, pose, 0.1).isWithin(0.1);
export const error: OvoidError | null = verify(box, same, null, pose, JSON.parse('{}') as AnswerFields);
export const lower: Float64Array = batch('distance', [{ shape: box }, { shape: same, pose }], [[0, 1]]).lower;
export const hits: boolean = impact({ shape: box, start: {} }, { shape: same, start: pose }).status === 'hit';
export const free = (robot: InstanceType<typeof Robot>): boolean => robot.collide([0]).status === 'free';

// @ts-expect-error a status that is none
export const a: boolean = answer.status === 'seperated';
// @ts-expect-error a status that is none
answer.is('apart');
// @ts-expect-error a status of motions
export const b: boolean = answer.status === 'free';
// @ts-expect-error a name of no status
export const c = Status.apart;
// @ts-expect-error an answer is no number
export const d: boolean = answer < 0.1;
// @ts-expect-error an option that is none
distance(box, same, null, pose, { tolerance: 1 });
// @ts-expect-error a pose in the place of a body
distance(box, null, same, pose);
// @ts-expect-error both sizes of a box
Shape.box({ half: [1, 1, 1], size: [2, 2, 2] });
// @ts-expect-error a field of poses that is none
distance(box, same, { position: [0, 0, 0] });
// @ts-expect-error a limit that is none
export const e: boolean = answer.limit === 'time';
