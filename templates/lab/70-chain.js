// One chain in space and time, its masses in motion, and its gaps with impacts beside the rise.

function chain(bench) {
  const drawn = base.forces.drawn;
  // The second chain at the printed threshold, in which impacts spread to most gaps.
  const FIRST = { sigma: drawn.sigma, T: base.transient, W: base.window, n: base.chain.masses, r: base.chain.restitution, realisation: 1, seed: drawn.seed };
  const initial = from_address("chain", FIRST) ?? FIRST;
  const force = fields([
    { name: "sigma", title: "force *σ*", unit: "*dω*²", slider: [0, 0.3], step: 0.0025, bounds: [0, 1], value: initial.sigma },
  ], () => update());
  const times = fields([
    { name: "T", title: "wait *T*", unit: "1/*ω*", stops: TRANSIENTS, bounds: [0, 10000], value: initial.T },
    { name: "W", title: "count for *W*", unit: "1/*ω*", stops: WINDOWS, bounds: [1, 10000], value: initial.W },
  ], () => update());
  const more = fields([
    { name: "n", title: "masses *n*", slider: [1, 1000], step: 1, whole: true, bounds: [1, 1000], value: initial.n },
    { name: "r", title: "restitution *r*", slider: [0, 1], step: 0.01, bounds: [0, 1], value: initial.r },
    { name: "realisation", title: "realisation", slider: [0, 999], step: 1, whole: true, bounds: [0, 1e9], value: initial.realisation },
    { name: "seed", title: "seed", slider: [1, 9999], step: 1, whole: true, bounds: [0, 2 ** 53], value: initial.seed },
  ], () => update());
  const groups = [force, times, more];
  const get = () => Object.assign({}, ...groups.map((group) => group.get()));
  const set = (values) => groups.forEach((group) => group.set(values));

  const choice = make("select", { ariaLabel: "Runs of this edition" }, make("option", { value: "", textContent: "your settings" }),
    ...runs.map(({ name }, i) => make("option", { value: i, textContent: name })));
  const another = button("Another chain", () => {
    set({ realisation: (get().realisation + 1) % 1000 });
    update();
  });
  const [told, proof, said_of_times] = [make("output"), make("output"), make("output")];
  const [where, against] = [make("canvas"), make("canvas")];
  const cursor = make("div", { className: "cursor", hidden: true });
  const [masses, link] = [row(put_cursor), shared()];
  let [latest, place] = [undefined, undefined];
  const ensemble = many(() => latest.asked, () => latest && draw_rise());
  const [of_jump, of_earlier] = [key("purple", "the most likely number jumps to all gaps", "peak"), make("span")];
  const waits = WAITS.map(({ name, protocol: { transient, window } }) => `${name}: *T* = ${transient}, *W* = ${window}`).join("; ");
  const legend = keys(["blue", "your chains, the last one large", "dot"], ["red", "mean of our chains with an impact; a disc at half of all gaps"], ["red", `the same for a ${waits}`, "", 0.45],
    ["red", "mean of all our chains", "dashed"], ["pale", "nine chains in ten", "band"], ["green", "theory, Eq. (25)"]);
  legend.append(of_jump, of_earlier);
  bench.append(
    masses.node,
    make("div", { className: "first" }, force.node, make("div", { className: "controls" }, another, link.copy_link), times.node),
    make("div", { className: "pair" },
      make("div", {}, make("div", { className: "place" }, where, cursor), told, proof),
      make("div", {}, against, said_of_times, ensemble.node)),
    legend,
    make("details", {}, make("summary", {}, "Masses, restitution, seed; runs of this edition to repeat; link and command"), more.node, make("div", { className: "controls" }, choice), link.node));

  // The stored run that is most like this one: of the same kind, then of the nearest force.
  const unlike = (a, b) => Number(JSON.stringify(a) !== JSON.stringify(b));
  const nearest = (asked) => {
    const distances = runs.map((one) => {
      const [{ forces: { drawn: of } }, { forces: { drawn } }] = [one.asked, asked];
      if (!of) return Infinity;
      const kind = unlike(one.asked.chain, asked.chain) + unlike([one.asked.transient, one.asked.window], [asked.transient, asked.window]);
      return kind + 10 * Math.abs(of.sigma - drawn.sigma) + 0.01 * unlike({ ...of, sigma: 0 }, { ...drawn, sigma: 0 });
    });
    return distances.indexOf(Math.min(...distances));
  };

  function draw_chain({ asked: { transient: from, window }, found }, state) {
    const until = from + window;
    told.replaceChildren(...rich(`${found.distinct} of ${found.gaps} gaps have impacts from *t* = ${said(from)} to ${said(until)}; impacts in all: ${found.impacts.toLocaleString("en")}${state}.`));
    const picture = plot(where, tall(300), [0, until, "time *t* (1/*ω*)"], [0, found.gaps, "gap"], `Gap against time, a mark for each impact. ${told.textContent}`);
    picture.band([[from, 0, found.gaps], [until, 0, found.gaps]], "orange", 0.22);
    picture.words("counted", Math.min(from + window / 2, 0.88 * until), found.gaps, "orange");
    picture.image(impacts(found));
    if (found.impacts === 0 && state === "") picture.words("no impact", until / 2, found.gaps / 2);
    // The gaps between the masses that are seen in motion.
    const [low, high] = masses.shown();
    picture.line([[0, low], [0, Math.min(high + 1, found.gaps)]], "blue", [], 10);
    place = picture.at;
  }

  /** Marks the moment that the row of masses shows. */
  function put_cursor(time) {
    cursor.hidden = place === undefined;
    if (cursor.hidden) return;
    const [left, top, bottom] = place(time);
    Object.assign(cursor.style, { left: `${left}px`, top: `${top}px`, height: `${bottom - top}px` });
  }

  // Chains that differ in nothing but σ, seed and realisation are shown together, and fainter those
  // of earlier times.
  const [KEPT, EARLIER] = [500, 3];
  let [sets, theory] = [[], []];
  const run_here = (means) => (ensemble.points().length > 0 ? ensemble.points() : means);
  function draw_rise() {
    if (sets.length === 0) return;
    const { asked, found: { gaps } } = latest;
    const curves = computed(asked);
    const whole = (line) => line.map(([sigma, ...shares]) => [sigma, ...shares.map((share) => share * gaps)]);
    const { points, means } = sets.at(-1);
    const last = points.at(-1);
    said_of_times.replaceChildren(...rich(finding(curves)));
    const picture = plot(against, tall(300), [0, Math.max(0.3, last[0]), "*σ* (*dω*²)"], [0, 1.08 * gaps, `gaps with an impact (of ${gaps})`],
      `Gaps with an impact against σ: your chains, the last of which has ${Math.round(last[1] * gaps)} at σ = ${last[0]}; the means of this edition; the theory. ${said_of_times.textContent}`);
    picture.fade(curves.holds ? 1 : 0.3);
    picture.band(whole(curves.band), "pale");
    picture.line(whole(curves.all), "red", [5, 4]);
    picture.line(whole(curves.hit), "red");
    if (curves.half) picture.marks([[curves.half.value, gaps / 2]], "red", 4);
    if (curves.jump?.jumps) picture.peak(curves.jump.sigma.value, "purple");
    if (curves.holds) draw_waits(picture, gaps, whole);
    picture.fade(0.3);
    picture.line(whole(curves.few), "red", [], 1);
    picture.fade(1);
    if (!curves.holds) picture.words(`for ${curves.label}`, 0.005, 1.01 * gaps, "grey", 0);
    picture.line([[printed, 0], [printed, 1.02 * gaps]], "ink", [2, 4], 1.5);
    picture.words(`printed: ${printed}`, printed - 0.004, 1.02 * gaps, "ink", 1);
    picture.line(whole(theory), "green");
    // The name is beside its curve, where that begins to rise.
    const rises = (theory.find(([, share]) => share > 0.1) ?? [0.25])[0];
    picture.words("theory", rises + 0.006, 0.05 * gaps, "green", 0);
    const earlier = sets.slice(0, -1).map((one, i) => [one, 0.6 ** (sets.length - 1 - i)]);
    for (const [one, strength] of earlier) {
      picture.fade(strength);
      picture.marks(whole(one.means), "blue", 4);
      picture.marks(whole(one.points), "blue", 2.5);
    }
    picture.fade(1);
    of_jump.hidden = !curves.jump?.jumps;
    of_earlier.replaceChildren(...earlier.map(([{ label }, strength]) => key("blue", `your chains at ${label}`, "dot", strength)));
    const own = whole(run_here(means));
    picture.fade(ensemble.strength());
    picture.line(own, "blue", [], 1);
    picture.marks(own, "blue", 4);
    picture.fade(1);
    picture.marks(whole(points), "blue", 2.5);
    picture.marks(whole([last]), "blue", 6);
  }

  /** How far the rise moves between the shortest wait and the longest. */
  function draw_waits(picture, gaps, whole) {
    picture.fade(0.45);
    for (const { hit } of WAITS) picture.line(whole(hit), "red");
    picture.fade(1);
    const [[short, left], [long, right]] = WAITS.map(({ name, half }) => [name, half.value]);
    picture.words(short, left + 0.012, 0.46 * gaps, "red", 0);
    picture.words(long, right - 0.006, 0.52 * gaps, "red", 1);
  }

  async function draw_all() {
    const { asked, found } = latest;
    draw_chain(latest, "");
    if (!asked.forces.drawn) return;
    const { masses: n, restitution: r } = asked.chain;
    const of_chain = [n, r, asked.chain.boundary, asked.chain.start].join();
    const label = `*T* = ${asked.transient}, *W* = ${asked.window}`;
    const [last, alike] = [sets.at(-1), sets.filter((one) => one.of_chain === of_chain)];
    const now = alike.find((one) => one.label === label) ?? { of_chain, label, points: [], means: [] };
    now.points = [...now.points, [asked.forces.drawn.sigma, found.distinct / found.gaps]].slice(-KEPT);
    if (now !== last) {
      if (last) last.means = run_here(last.means);
      const module = await engine();
      theory = SIGMAS.map((sigma) => [sigma, module.mean(n + 1, module.p(sigma)) / (n + 1)]);
      sets = [...alike.filter((one) => one !== now), now].slice(-1 - EARLIER);
      ensemble.clear();
    }
    draw_rise();
  }

  /** Says whether the bits are those of this edition, or which run has such a proof. */
  function prove(asked, found) {
    const known = runs.find((one) => JSON.stringify(one.asked) === JSON.stringify(asked));
    if (known) {
      const same = known.found.digest === found.digest;
      const eight = ({ digest }) => make("code", { textContent: digest.slice(0, 8), title: digest });
      proof.append(make("strong", { textContent: same ? "✓ same bits" : "✗ NOT the same bits" }), " as in this edition (", eight(found), ")");
      if (!same) proof.append("; there ", eight(known.found));
    }
    if (found.impacts === 0) proof.append(known ? ". " : "", "No impact: neighbours never swing so differently that the gap between them, of width d, closes. ");
    if (!known && asked.forces.drawn) {
      const near = nearest(asked);
      proof.append("Does your machine find our bits? Try ", button(runs[near].name, () => repeat(near)));
    }
  }

  async function show(asked) {
    const began = performance.now();
    proof.replaceChildren();
    const found = await run(asked, (found) => draw_chain({ asked, found }, `, so far to *t* = ${said(found.time)}`));
    if (!found) return;
    // The module's memory is that of the next run; a window that gets another size draws this one.
    latest = { asked, found: { ...found, picture: found.picture.slice() } };
    await masses.show(latest.found, asked);
    await draw_all();
    masses.draw();
    Object.assign(bench.dataset, { time: performance.now() - began, digest: found.digest, bytes: found.bytes });
    prove(asked, found);
  }
  function draw() {
    if (!latest) return;
    draw_chain(latest, "");
    masses.draw();
    if (latest.asked.forces.drawn) draw_rise();
  }
  const guarded = async (what) => {
    try {
      await show(what());
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      turn += 1;
      told.textContent = error.message;
      proof.replaceChildren();
    }
  };
  const request = () => {
    const { sigma, n, r, T, W, seed, realisation } = get();
    const asked = { ...base, chain: { ...base.chain, masses: n, restitution: r }, forces: { drawn: { ...drawn, sigma, seed, realisation } }, transient: T, window: W };
    const known = runs.findIndex((one) => JSON.stringify(one.asked) === JSON.stringify(asked));
    choice.value = known < 0 ? "" : known;
    link.show(fragment("chain", get(), FIRST), asked);
    return asked;
  };
  const update = () => guarded(() => {
    const asked = request();
    history.replaceState(null, "", fragment("chain", get(), FIRST));
    return asked;
  });
  const repeat = (i) => guarded(() => {
    const { asked } = runs[i];
    choice.value = i;
    const { sigma, seed, realisation } = asked.forces.drawn ?? FIRST;
    set({ sigma, seed, realisation, n: asked.chain.masses, r: asked.chain.restitution, T: asked.transient, W: asked.window });
    link.show(fragment("chain", get(), FIRST), asked);
    return asked;
  });
  choice.addEventListener("change", () => choice.value && repeat(Number(choice.value)));
  addEventListener("hashchange", () => {
    const values = from_address("chain", FIRST);
    if (!values) return;
    set(values);
    bench.scrollIntoView();
    guarded(request);
  });
  return { begin: () => guarded(request), draw };
}
