// Twenty chains at each σ, run here: the reader's own rise.

const EACH = 20;
const RISE = Array.from({ length: 21 }, (_, i) => (14 + i) / 200);

/** The mean share over the chains with an impact, for each σ at which there is one. */
const means = (shares) => [...shares].flatMap(([sigma, all]) => {
  const hit = all.filter((share) => share > 0);
  return hit.length > 0 ? [[sigma, hit.reduce((a, b) => a + b, 0) / hit.length]] : [];
});

/** Where points first rise through one half, on a line between two of them. */
function half_height(points) {
  const i = points.findIndex(([, y], i) => i > 0 && y >= 0.5 && points[i - 1][1] < 0.5);
  if (i < 0) return undefined;
  const [[x0, y0], [x1, y1]] = [points[i - 1], points[i]];
  return x0 + ((0.5 - y0) / (y1 - y0)) * (x1 - x0);
}

/** A button that runs them, with progress; `asked` gives the run whose σ and realisation vary. */
function many(asked, changed) {
  const progress = make("progress", { max: EACH * RISE.length, value: 0, hidden: true, ariaLabel: "chains run" });
  const told = make("output");
  const begin = button(`Run ${EACH} chains at each σ`, () => (running ? stop() : work()));
  const node = make("div", { className: "controls many" }, begin, progress, told);
  let [shares, running, module] = [new Map(), 0];
  const words = () => {
    const done = progress.value;
    const place = done === progress.max && half_height(means(shares));
    const own = place ? `; the mean of those with an impact passes half of all gaps near *σ* = ${place.toFixed(3)}` : "";
    told.replaceChildren(...rich(done > 0 ? `${done} of ${progress.max} chains${own}.` : ""));
  };
  function show(is_running) {
    progress.hidden = !is_running;
    begin.textContent = is_running ? "Stop" : `Run ${EACH} chains at each σ`;
    words();
    changed();
  }
  const stop = () => ((running = 0), show(false));
  async function work() {
    const [own, of] = [Math.random(), asked()];
    [running, shares, progress.value] = [own, new Map(RISE.map((sigma) => [sigma, []])), 0];
    show(true);
    module ??= await start();
    let since = performance.now();
    // All σ once, then all again: the whole rise is there at once, and gets sharper.
    for (let realisation = 0; realisation < EACH; realisation += 1) {
      for (const sigma of RISE) {
        module.open({ ...of, forces: { drawn: { ...of.forces.drawn, sigma, realisation } } });
        while (module.advance(500)) {
          if (performance.now() - since < SLICE) continue;
          await breath();
          if (running !== own) return;
          since = performance.now();
        }
        const { distinct, gaps } = module.found();
        shares.get(sigma).push(distinct / gaps);
        progress.value += 1;
        if (progress.value % 7 === 0) (words(), changed());
      }
    }
    stop();
  }
  return {
    node,
    points: () => means(shares),
    // Points of few chains are faint.
    strength: () => (running ? 0.3 + (0.7 * progress.value) / progress.max : 1),
    /** Forgets what was run, as after a change of the chain. */
    clear() {
      shares = new Map();
      progress.value = 0;
      stop();
    },
  };
}
