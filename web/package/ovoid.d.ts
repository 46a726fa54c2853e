// ovoid: proximity of convex bodies, compounds of these and solids of triangles, with proofs.
// Lengths have one unit, the caller's; angles are radians. Poses map a body's frame to the world's. Every bracket is true,
// rounding included: lower <= signed distance <= upper. What is wrong with an argument is thrown: OvoidError by the
// library, TypeError for what is not of the shape that is written here.

export type Vector = readonly [number, number, number] | Float64Array | readonly number[];
/** At xyz (the origin), turned by one of the three (not turned): quaternions of any length but zero, or roll, pitch, yaw. */
export interface Pose { xyz?: Vector; quat_wxyz?: readonly number[]; quat_xyzw?: readonly number[]; rpy?: Vector }

export declare class OvoidError extends Error {
  /** The number of ovoid_code. */
  code: number;
  /** Vertex, face, item or byte, from 0; -1 where none applies. */
  place: number;
}

export interface ShapeOptions {
  /** Rounding radius >= 0, added around the hull. */
  radius?: number;
  /** Relative volume gap of the ellipsoids, 1e-6, of a lean shape 0.1. */
  gap?: number;
  /** Lean: made in two thirds of the time; queries are as true, but slower. */
  inner?: 'maximum' | 'phases' | 'lean';
  /** What the true body may differ by: brackets are of the true body. With an axis, it stands out across that alone. */
  allowance?: { outside?: number; inside?: number; axis?: number[] | null };
}
/** { x : (x - center)' Q^-1 (x - center) <= 1 }, q the upper triangle of Q: xx xy xz yy yz zz. */
export interface Ellipsoid { center: number[]; q: number[]; volume: number; gap: number }
export interface Description {
  vertexCount: number; triangleCount: number;
  /** 0 point, 1 segment, 2 flat, 3 solid. */
  rank: number;
  radius: number; allowance: { outside: number; inside: number; axis: number[] | null };
  volume: number; area: number; centroid: number[]; inertia: number[];
  box: { min: number[]; max: number[] };
  /** Of the body frame, which vertices and ellipsoids are in, in the frame of the points given. */
  origin: number[];
  outer: Ellipsoid; inner: Ellipsoid; isLean: boolean;
}

/** A convex body: immutable, shared by any number of poses. Memory goes back by free(), or when nobody holds it. */
export declare class Shape {
  private constructor();
  /** The convex hull of points: n arrays of three, or 3 n numbers. */
  static fromPoints(points: ArrayLike<number> | readonly Vector[], options?: ShapeOptions): Shape;
  /** The convex hull of a solid's points. */
  static hullOf(solid: Solid): Shape;
  /** Half sizes, as in C and Python; or by name: `{ half }`, `{ size }`. */
  static box(half: Vector | { half: Vector; size?: never } | { size: Vector; half?: never }, options?: ShapeOptions): Shape;
  static sphere(radius: number, options?: ShapeOptions): Shape;
  /** Along z, as are all of the following. */
  static capsule(radius: number, halfLength: number, options?: ShapeOptions): Shape;
  /** The true cylinder, its bracket wider by `tolerance` at most (radius / 200). */
  static cylinder(radius: number, halfLength: number, options?: ShapeOptions & { tolerance?: number }): Shape;
  static cone(radius: number, halfLength: number, options?: ShapeOptions & { tolerance?: number }): Shape;
  /** The true ellipsoid around the origin, with half axes along x, y, z. */
  static ellipsoid(halfAxes: Vector, options?: ShapeOptions & { tolerance?: number }): Shape;
  static prism(radius: number, halfLength: number, sides: number, options?: ShapeOptions): Shape;
  static pyramid(radius: number, halfLength: number, sides: number, options?: ShapeOptions): Shape;
  /** From the bytes of an .ovoid file, all of them checked. */
  static fromBytes(bytes: Uint8Array): Shape;
  toBytes(): Uint8Array;
  readonly description: Description;
  /** 3 numbers each, body frame: copies. */
  readonly vertices: Float64Array;
  readonly triangles: Uint32Array;
  readonly volume: number; readonly outer: Ellipsoid; readonly inner: Ellipsoid;
  free(): void;
}

/** The statuses by name: `answer.status === Status.separated`. TypeScript refuses to compare with a name that is none. */
export declare const Status: { readonly undecided: 'undecided'; readonly separated: 'separated'; readonly touching: 'touching'; readonly overlapping: 'overlapping' };
export type Status = (typeof Status)[keyof typeof Status];
export type Limit =
  | 'none' | 'answered' | 'cap' | 'iterations' | 'precision' | 'capacity' | 'pose_a' | 'pose_b' | 'options' | 'shape_a' | 'shape_b' | 'allowance' | 'memory';
export type Stage = 'none' | 'proof' | 'sphere' | 'outer' | 'support' | 'inner' | 'gjk' | 'epa' | 'refine';
export interface Proof {
  normal: number[]; normal_low?: number[];
  kind: 'none' | 'points' | 'hull' | 'inner' | 'inner_points' | 'cover' | 'balls';
  a: number[]; b: number[]; weight_a: number[]; weight_b: number[];
  inner_a?: number[]; inner_b?: number[];
  cover?: { pairs: number[][]; triangles: number[][] };
  /** Of compounds and solids: why no other parts decide; and of solids the bracket of their surfaces, and what parts the bodies. */
  exclusions?: { a: number[]; b: number[]; normal: number[]; normal_low?: number[]; lower: number }[];
  surfaces?: { status: Status; limit: Limit; lower: number; upper: number }; parting?: number[];
}
/** As a line of the tool's JSON: `ovoid check --json` writes what `verify` takes. */
export interface AnswerFields {
  status: Status; limit: Limit; lower: number; upper: number;
  /** World frame; the normal is from a to b. */
  point_a: number[]; point_b: number[]; normal: number[];
  stage: Stage; iterations: number; proof: Proof;
  /** What decided: of a compound the part, of a solid the triangle; and of solids which component is inside the other. */
  part_a?: number; part_b?: number; triangle_a?: number; triangle_b?: number; inside?: 'a in b' | 'b in a' | 'common point'; component?: number;
  common?: [number, number, number];
}
/** What a query returns. An object is always true in JavaScript: ask `answer.is('overlapping')`, not `if (answer)`. Used as a number it throws. */
export interface Answer extends AnswerFields {
  /** Whether the status is this one; a name that is none throws. */
  is(status: Status): boolean;
  /** Whether the bodies are within the margin: true, false, or null where the bracket does not say. */
  isWithin(margin: number): boolean | null;
  toJSON(): AnswerFields;
}
export interface Options {
  absoluteTolerance?: number;
  /** Of the pair's size: 1e-9. */
  relativeTolerance?: number;
  /** Stop when proven farther than this. */
  cap?: number;
  iterations?: number;
  /** The answer about this pair a moment ago: where the search begins. */
  earlier?: AnswerFields;
}
export interface Body { shape: Shape; pose?: Pose }
/** A column of each; status, stage and limit are numbers of names. */
export interface Batch { lower: Float64Array; upper: Float64Array; status: Uint8Array; stage: Uint8Array; limit: Uint8Array }

/** A point of contact; the id stays as long as its features do: a vertex, or two edges. */
export interface ContactPoint { id: number; point_a: number[]; point_b: number[]; separation: number }
/** A contact as in the tool's JSON: `ovoid check --contacts --json` writes what `verifyManifold` takes. Without one the axis is 'none'. */
export interface ManifoldFields {
  /** Of a compound the part, else 0. */
  part_a: number; part_b: number;
  status: Status; limit: Limit;
  /** lower is the gap along the normal, which is from a to b. */
  lower: number; upper: number; normal: number[];
  axis: 'none' | 'face a' | 'face b' | 'edges' | 'free'; feature_a: number; feature_b: number; facet_a: number; facet_b: number; flags: number;
  /** Of the whole polygon, of whose area the points span this share; inner and outer bracket the area in contact. */
  corners: number; share: number; inner: number; outer: number;
  /** Each point lies on its body grown by this. */
  grown: number;
  /** Up to four. */
  points: ContactPoint[];
  proof: 'none' | 'points' | 'facets' | 'search' | 'normal'; cover?: { pairs: number[][]; triangles: number[][] };
}
export interface Manifold extends ManifoldFields { toJSON(): ManifoldFields }
export interface ManifoldOptions {
  /** Contacts are given up to this distance. */
  margin?: number;
  /** A kept contact is used again without a search while its bracket is at most this wide; 0: 1e-9 of the pair's size. */
  tolerance?: number;
  /** A kept corner stays while it is outside by at most this. */
  keep?: number;
  /** Facets turned from the plane of contact by more radians touch with an edge or a vertex alone; 0: 1.45. */
  angle?: number;
}

export interface SmoothValue {
  value: number; error: number; condition: number; isSmooth: boolean; point_a: number[]; point_b: number[]; normal: number[];
  /** By translation of a (3), rotation of a (3), of b (6). */
  gradient: number[]; hessian?: number[][];
}
export interface Moving { shape: Shape; start: Pose; end?: Pose }
export interface MotionOptions { duration?: number; margin?: number; tolerance?: number }
export type BareAnswer = Omit<AnswerFields, 'proof'>;
export interface Impact {
  status: 'undecided' | 'free' | 'hit'; limit: Limit; iterations: number; begin: number; end: number;
  /** The time of impact is in [free_until, hit_at]; Infinity: none is proven. */
  free_until: number; hit_at: number; steps: number; free: BareAnswer; hit: BareAnswer;
}
export interface Approach {
  status: Status; limit: Limit; iterations: number; begin: number; end: number; lower: number; upper: number; time: number; answer: BareAnswer;
}

export interface SolidReport {
  points: number; triangles: number; components: number; edgesUnmatched: number; edgesCrowded: number; degenerate: number; duplicates: number;
  isClosed: boolean; volume: number; area: number; box: { min: number[]; max: number[] };
}
/** Shapes with poses in one body, its union. The shapes are borrowed: one that was freed is refused. */
export declare class Compound {
  constructor(parts: readonly { shape: Shape; pose?: Pose }[]);
  readonly parts: readonly { shape: Shape; pose?: Pose }[];
  free(): void;
}
/** Closed triangles: the body they wind around; open ones: the surface. */
export declare class Solid {
  private constructor();
  static fromTriangles(points: ArrayLike<number> | readonly Vector[], triangles: ArrayLike<number> | readonly (readonly number[])[]): Solid;
  readonly report: SolidReport;
  free(): void;
}
export interface Joint {
  name: string; type: 'fixed' | 'revolute' | 'continuous' | 'prismatic' | 'planar' | 'floating'; parent: string; child: string;
  origin?: Pose; axis?: Vector; lower?: number; upper?: number; velocity?: number; mimic?: { joint: string; multiplier?: number; offset?: number };
}
export interface RobotDescription {
  links: string[]; joints: Joint[];
  /** Bodies are borrowed: do not free them before the robot. A Solid is asked about with all its dents. */
  elements?: { link: string; shape: Shape | Solid; pose?: Pose }[];
  disabled?: [string, string][];
}
export interface Side { link: string | null; element: number | null; obstacle: number | null; part: number }
/** code: of a refused state why, of variable; of an undecided one without a and b: no pair is asked about. */
export interface StateAnswer { status: 'undecided' | 'free' | 'hit' | 'refused'; code?: string; variable?: number; a?: Side; b?: Side; lower?: number; upper?: number }
export interface NearPair { a: Side; b: Side; status: Status; lower: number; upper: number; point_a: number[]; point_b: number[]; normal: number[] }
export declare class Robot {
  constructor(description: RobotDescription);
  readonly description: RobotDescription;
  readonly variableCount: number;
  poses(q: ArrayLike<number>): { xyz: number[]; quat_wxyz: number[] }[];
  /** Adds an obstacle; attaches a body to a link, in whose frame its pose is, and which may touch this link and some others. */
  add(body: AnyBody, pose?: Pose): number;
  attach(link: string, body: AnyBody, pose?: Pose, touching?: readonly string[]): number;
  move(id: number, pose: Pose): void;
  remove(id: number): void;
  /** Lets two links, or a body and a link, touch; or takes that back. */
  allow(a: string, b: string, allowed?: boolean): void;
  allowBody(id: number, link: string, allowed?: boolean): void;
  /** Enlarges a link, with what is attached to it, against obstacles. */
  setPadding(link: string, padding: number): void;
  /** One with variables outside their limits by more than limitSlack (Infinity) is refused. */
  collide(q: ArrayLike<number>, margin?: number, limitSlack?: number): StateAnswer;
  near(q: ArrayLike<number>, margin: number, most?: number): NearPair[];
  free(): void;
}

export type AnyBody = Shape | Compound | Solid;
type Ask<B> = (a: B, b: B, poseA?: Pose | null, poseB?: Pose | null, options?: Options) => Answer;
type AskWithin<B> = (a: B, b: B, poseA: Pose | null | undefined, poseB: Pose | null | undefined, margin: number, options?: Options) => Answer;

export interface Ovoid {
  version: string;
  /** What the module has of memory; it grows and never shrinks. */
  readonly memoryBytes: number;
  names: { status: Status[]; stage: Stage[]; limit: Limit[]; kind: string[]; axis: string[]; contactProof: string[] };
  Shape: typeof Shape; Compound: typeof Compound; Solid: typeof Solid; Robot: typeof Robot; OvoidError: typeof OvoidError; Status: typeof Status;
  /** Do they touch? Ends as soon as the sign is proven. */
  collide: Ask<AnyBody>;
  within: AskWithin<AnyBody>;
  /** The distance; of an overlap that it is one, and with a solid a true bracket of the depth. */
  distance: Ask<AnyBody>;
  /** The signed distance: minus the penetration depth where they overlap; of compounds of the deepest parts. */
  depth: Ask<Shape | Compound>;
  /** Checks an answer by its proof alone, its status by the tolerance of the options that it was asked with. null: it holds; else what does not. */
  verify(a: AnyBody, b: AnyBody, poseA: Pose | null | undefined, poseB: Pose | null | undefined, answer: AnswerFields, options?: Options): OvoidError | null;
  /** Many couples [a, b] of bodies at once, eight in lanes; the statuses of single queries. */
  batch(kind: 'collide' | 'within' | 'distance' | 'depth', bodies: readonly Body[], couples: Uint32Array | readonly (readonly [number, number])[], options?: Omit<Options, 'earlier'> & { margin?: number }): Batch;
  /** The contact of two shapes. earlier: that of a moment ago, which is moved on and measured again where it still holds: ids stay. */
  findManifold(a: Shape, b: Shape, poseA?: Pose | null, poseB?: Pose | null, options?: ManifoldOptions & { earlier?: ManifoldFields }): Manifold;
  /** The contacts of all pairs of parts that are not proven farther apart than the margin, by their parts; of one Solid by its flat facets. */
  findManifolds(a: AnyBody, b: AnyBody, poseA?: Pose | null, poseB?: Pose | null, options?: ManifoldOptions): Manifold[];
  /** Checks a contact without a search, by the options that it was found with. null: it holds; else what does not. */
  verifyManifold(a: AnyBody, b: AnyBody, poseA: Pose | null | undefined, poseB: Pose | null | undefined, manifold: ManifoldFields, options?: ManifoldOptions): OvoidError | null;
  /** The whole polygon of a contact. */
  computePolygon(a: Shape | Compound, b: Shape | Compound, poseA: Pose | null | undefined, poseB: Pose | null | undefined, manifold: ManifoldFields, options?: ManifoldOptions): { points: ContactPoint[]; grown: number; inner: number; outer: number };
  /** The signed distances of both ellipsoids: outer.value <= d <= inner.value. order 1: gradients, 2: Hessians too. */
  smooth(a: Shape, b: Shape, poseA?: Pose | null, poseB?: Pose | null, order?: 0 | 1 | 2): { limit: Limit; outer: SmoothValue; inner: SmoothValue };
  /** When two shapes that move from start to end (straight, and turned by a slerp; time 0 to duration) first come within the margin. */
  impact(a: Moving, b: Moving, options?: MotionOptions): Impact;
  /** How near they come, and when. */
  approach(a: Moving, b: Moving, options?: MotionOptions): Approach;
}

/** Loads the module, from beside this file, an address, bytes or a compiled module. */
export declare function load(source?: URL | string | BufferSource | Response | WebAssembly.Module): Promise<Ovoid>;
