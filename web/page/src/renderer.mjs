// What draws: WebGL 2, or a painter where there is none.
import { WebGLRenderer } from 'three';
import { Painter } from './painter.mjs';

/**
 * The renderer of a canvas, with limits: the fewest and the most triangles of a picture, how many a millisecond before that
 * is known, and from how many triangles or bodies a layer has coarser levels.
 */
export function makeRenderer(canvas) {
  if (!document.createElement('canvas').getContext('webgl2')) return new Painter(canvas);
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, stencil: true, preserveDrawingBuffer: true }), gl = renderer.getContext();
  renderer.limits = { fewest: 20000, most: 3000000, rate: 3000, levels: { triangles: 100000, items: 1000 } };
  /** Calls back when all that was drawn is there. */
  renderer.wait = (done) => {
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const ask = () => {
      if (gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) return setTimeout(ask, 4);
      gl.deleteSync(sync);
      done();
    };
    setTimeout(ask, 0);
  };
  return renderer;
}
