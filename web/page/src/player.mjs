// Playing something that has a length, as a film that begins anew where it ends.
import { element } from './panel.mjs';

export class Player {
  /** last: where it ends; set: called with the place, a number from 0 to last. */
  constructor(last, seconds, get, set) {
    Object.assign(this, { last, seconds, get, set });
    this.button = element('button', { id: 'play', textContent: '▶', title: 'play (space)', 'aria-label': 'play', onclick: () => this.toggle() });
  }

  toggle() {
    this.isPlaying = !this.isPlaying;
    this.button.textContent = this.isPlaying ? '⏸' : '▶';
    const begin = performance.now(), from = this.get() >= this.last ? 0 : this.get();
    const step = (now) => {
      if (!this.isPlaying) return;
      this.set((from + (Math.max(0, now - begin) / 1000 / this.seconds) * this.last) % (this.last * (1 + 1e-9)));
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}
