// The data of a page (format 1), decoded.
import { shorten } from './text.mjs';

export function decodeBytes(text) {
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
const decode = (Type, text) => new Type(decodeBytes(text).buffer);

/** The bytes of the module, packed by gzip. */
export async function unpack(text) {
  const stream = new Blob([decodeBytes(text)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Which body a side of a robot's pair is: an element of a link, in its order, or a part of an obstacle. */
export const sideKey = ({ link, element, obstacle, part }) => (link !== undefined ? `link ${element} ${link}` : `obstacle ${part} ${obstacle}`);

// Groups of things by a name, in their order.
function groupBy(list, name) {
  const groups = new Map();
  for (const item of list) groups.set(item[name], [...(groups.get(item[name]) ?? []), item]);
  return groups;
}

/** Adds a body for each element of a link, for what a link holds, and for each obstacle, named as the tool names them. */
function addRobot(data) {
  const { robot } = data;
  if (!robot) return;
  data.bodies = [];
  const add = (item, side, name, more) => {
    item.key = sideKey(side);
    data.bodies.push({ name, key: item.key, parts: [{ shape: item.shape }], pose: item.pose, solid: item.solid, ...more });
  };
  for (const [link, parts] of groupBy([...robot.elements, ...(robot.held ?? [])], 'link'))
    parts.forEach((e, i) => add(e, { link, element: i }, parts.length > 1 ? `${link}[${e.name ?? i}]` : link, { link, at: e.pose }));
  for (const [name, parts] of groupBy(robot.obstacles ?? [], 'name'))
    parts.forEach((o, i) => add(o, { obstacle: name, part: i }, parts.length > 1 ? `${name}[${i}]` : name, { obstacle: true }));
}

/** The page's data with arrays in the place of base64; throws where it is not what this page reads. */
export function readData(text) {
  const data = JSON.parse(text);
  if (!data) throw new Error('this page has no data: it is a template, which ovoid view --html fills');
  if (data.format !== 1) throw new Error(`the data have format ${data.format}, this page reads 1`);
  addRobot(data);
  data.title = shorten(data.title ?? 'scene');
  data.command = shorten(data.command ?? '', 2000);
  // Names of any length come from files: the keys stay, what is shown is cut.
  for (const body of data.bodies) Object.assign(body, { name: shorten(body.name), wholeName: body.name });
  for (const shape of data.shapes) {
    shape.bytes = decodeBytes(shape.bytes);
    if (shape.mesh) shape.mesh = { points: decode(Float32Array, shape.mesh.points), triangles: decode(Uint32Array, shape.mesh.triangles) };
    if (shape.solid) shape.solid = { points: decode(Float64Array, shape.solid.points), triangles: decode(Uint32Array, shape.solid.triangles) };
    if (shape.areas) shape.areas = decodeBytes(shape.areas);
  }
  if (data.motion) data.motion.poses = decode(Float64Array, data.motion.poses);
  data.pairs ??= [];
  // JSON has no infinities.
  for (const { answer } of data.pairs) Object.assign(answer, { lower: answer.lower ?? -Infinity, upper: answer.upper ?? Infinity });
  return data;
}
