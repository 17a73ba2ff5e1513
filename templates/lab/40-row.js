// Fig. 1 in motion: a dozen neighbours of the chain that is shown, moved by the engine, with a
// flash at each impact. Discs are drawn as far apart as their gap is wide, so they touch when it
// closes. Who prefers reduced motion sees them still until they ask for more.

const DOZEN = 12;
const PACE = 4; // units of time in a second
const FLASH = 1.5; // units of time for which a flash is seen
const BEFORE = 5; // units of time before the first impact

/** Where something happens first: the masses around that gap, its time, and one shortly before. */
function first_impact({ picture, columns, gaps }, { chain, transient, window }) {
  const first = (gap) => picture.subarray(gap * columns, (gap + 1) * columns).findIndex((count) => count > 0);
  const all = Array.from({ length: gaps }, (_, gap) => [first(gap), gap]).filter(([column]) => column >= 0);
  const [column, gap] = all.reduce((best, one) => (one[0] < best[0] ? one : best), [columns, 0]);
  const from = Math.max(0, Math.min(gap - DOZEN / 2, chain.masses - DOZEN));
  const hit = column < columns ? ((transient + window) * (column + 1)) / columns : 0;
  return { from, hit, time: Math.max(0, hit - BEFORE) };
}

function draw_row(canvas, { chain, from, count, positions, flashes, time }) {
  const numbers = `masses ${from + 1} to ${from + count}`;
  const { c, width } = sheet(canvas, tall(84), `A row of masses on springs, ${numbers}, as the engine moves them.`);
  const height = tall(84);
  const [disc, floor, middle, edge] = [width < 500 ? 11 : 18, height - 5, height * 0.4, 8];
  const scale = (width - 2 * edge - count * disc) / ((count + 1) * chain.spacing);
  // The left side of the disc of this mass where it is at x.
  const side = (x, i) => edge + (x - from * chain.spacing) * scale + i * disc;
  [c.strokeStyle, c.fillStyle] = [colour("grey"), colour("pale")];
  c.beginPath();
  c.lineTo(0, floor);
  c.lineTo(width, floor);
  c.stroke();
  if (chain.boundary !== "ring" && from === 0) c.fillRect(0, 4, side(0, 0), floor - 4);
  if (chain.boundary !== "ring" && from + count === chain.masses) c.fillRect(side((chain.masses + 1) * chain.spacing, count), 4, width, floor - 4);
  c.lineWidth = 1.5;
  for (let i = 0; i < count; i += 1) {
    const [rest, x] = [(from + i + 1) * chain.spacing, positions[from + i]].map((x) => side(x, i) + disc / 2);
    c.strokeStyle = colour("grey");
    c.beginPath();
    c.moveTo(rest, floor);
    c.quadraticCurveTo(rest, (floor + middle) / 2, x, middle);
    c.stroke();
    [c.fillStyle, c.strokeStyle] = [colour("soft"), colour("ink")];
    c.beginPath();
    c.arc(x, middle, disc / 2 - 0.75, 0, 7);
    c.fill();
    c.stroke();
  }
  for (const [gap, began] of flashes) {
    const i = gap - from - 1;
    if (i < -1 || i >= count) continue;
    const x = i < 0 ? side(positions[from], 0) : side(positions[from + i], i) + disc;
    const age = (time - began) / FLASH;
    [c.globalAlpha, c.strokeStyle, c.lineWidth] = [1 - age, colour("orange"), 3];
    c.beginPath();
    c.arc(x, middle, disc * (0.7 + age), 0, 7);
    c.stroke();
  }
}

/** The row with its button; `passed` hears of each moment that is shown. */
function row(passed) {
  const [canvas, told] = [make("canvas"), key("blue", "", "dot")];
  const play = button("Play", () => ((playing = !playing), (last = undefined), step()));
  const node = make("div", { className: "row" }, canvas, make("div", { className: "controls" }, play, told));
  let [playing, seen, asked, state, module, last, opened] = [!matchMedia("(prefers-reduced-motion: reduce)").matches, true];
  new IntersectionObserver(([{ isIntersecting }]) => ((seen = isIntersecting), (last = undefined), step())).observe(node);

  function move(time) {
    const { positions, hit } = module.follow(time, asked.chain.masses);
    hit.forEach((gap) => state.flashes.set(gap, time));
    state.flashes.forEach((began, gap) => time - began > FLASH && state.flashes.delete(gap));
    Object.assign(state, { positions, time });
  }
  function draw() {
    if (!state) return;
    draw_row(canvas, { ...state, chain: asked.chain });
    play.textContent = playing ? "Pause" : "Play";
    const of = asked.chain.masses > state.count ? ` of ${asked.chain.masses}` : "";
    told.replaceChildren(...rich(`masses ${state.from + 1} to ${state.from + state.count}${of} at *t* = ${state.time.toFixed(1)}, blue below; a flash is an impact`));
    passed(state.time);
  }
  let waiting;
  function step() {
    draw();
    if (!playing || !seen || !state) return;
    waiting ??= requestAnimationFrame((now) => {
      waiting = undefined;
      // After a pause, as of a page behind another, it goes on where it was.
      const passed = Math.min(0.1, (now - (last ?? now)) / 1000);
      last = now;
      const end = asked.transient + asked.window;
      if (state.time >= end) begin();
      else move(Math.min(end, state.time + PACE * passed));
      step();
    });
  }
  function begin() {
    module.open(asked);
    const { from, time } = opened;
    state = { from, count: Math.min(DOZEN, asked.chain.masses - from), flashes: new Map(), positions: [], time };
    move(time);
    state.flashes.clear();
    // What stands still shows the impact itself.
    if (!playing) move(Math.max(time, opened.hit));
  }
  return {
    node,
    draw,
    /** Shows masses of another run, where it first has an impact; returns which. */
    async show(found, of) {
      [opened, asked] = [first_impact(found, of), of];
      module ??= await start();
      if (asked !== of) return;
      begin();
      step();
    },
    shown: () => (opened ? [opened.from, opened.from + DOZEN] : [0, 0]),
  };
}
