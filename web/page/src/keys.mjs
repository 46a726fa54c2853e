// Keys of sliders, the same in all browsers, which differ in how far an arrow key goes on a slider of any step.

const STEPS = { arrowright: 1, arrowup: 1, arrowleft: -1, arrowdown: -1, pageup: 10, pagedown: -10 };

/** Arrow keys and page keys on an input call step with 1, -1, 10 or -10; in a text the keys right and left stay its own. */
export function stepByKeys(input, step) {
  input.addEventListener('keydown', (event) => {
    const key = event.key.toLowerCase(), isOwn = input.type === 'text' && (key === 'arrowright' || key === 'arrowleft');
    if (!STEPS[key] || isOwn || event.ctrlKey || event.metaKey || event.altKey) return;
    step(STEPS[key]);
    event.preventDefault();
  });
}
