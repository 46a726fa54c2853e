// The data of a page (format 1), decoded.

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

/** Adds what only one link of a robot or one obstacle is: bodies of one shape each. */
function addRobot(data) {
  const { robot } = data;
  if (!robot) return;
  data.bodies = [];
  const byLink = new Map(robot.links.map((name) => [name, []]));
  for (const element of robot.elements) byLink.get(element.link).push(element);
  for (const [link, elements] of byLink)
    if (elements.length) data.bodies.push({ name: link, link, pose: {}, parts: elements.map(({ shape, pose }) => ({ shape, pose })) });
  for (const { name, shape, pose } of robot.obstacles ?? []) data.bodies.push({ name, obstacle: true, pose, parts: [{ shape }] });
}

/** The page's data with arrays in the place of base64; throws where it is not what this page reads. */
export function readData(text) {
  const data = JSON.parse(text);
  if (!data) throw new Error('this page has no data: it is a template, which ovoid view --html fills');
  if (data.format !== 1) throw new Error(`the data have format ${data.format}, this page reads 1`);
  addRobot(data);
  for (const shape of data.shapes) {
    shape.bytes = decodeBytes(shape.bytes);
    if (shape.mesh) shape.mesh = { points: decode(Float32Array, shape.mesh.points), triangles: decode(Uint32Array, shape.mesh.triangles) };
    if (shape.solid) shape.solid = { points: decode(Float64Array, shape.solid.points), triangles: decode(Uint32Array, shape.solid.triangles) };
    if (shape.areas) shape.areas = decodeBytes(shape.areas);
  }
  if (data.motion) data.motion.poses = decode(Float64Array, data.motion.poses);
  data.pairs ??= [];
  return data;
}
