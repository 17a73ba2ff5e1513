// What readers run themselves: chains by the engine of this report, circuits by its theory, in
// WebAssembly. A page loads this when it is first asked to; what it has to hold the runs against is
// LAB, which the program writes before this.
globalThis.open_lab = (() => {
  const { runs, curve, module } = LAB;
  const make = (tag, properties = {}, ...children) => {
    const node = Object.assign(document.createElement(tag), properties);
    node.append(...children);
    return node;
  };
  const look = make("style", { textContent: `
    .bench { display: grid; gap: 0.5rem; margin-top: 0.8rem; max-width: 58rem; }
    .fields { display: grid; grid-template-columns: repeat(auto-fit, minmax(17rem, 1fr)); gap: 0.4rem 2rem; }
    .fields > div { display: grid; grid-template-columns: 7.5rem 1fr 5.5rem; gap: 0.6rem; align-items: center; font-size: 0.95rem; line-height: 1.2; }
    .bench input, .bench select { font: inherit; color: inherit; accent-color: var(--link); min-width: 0; }
    .bench input[type=number], .bench select { background: var(--soft); border: 1px solid var(--grey); border-radius: 4px; padding: 0.15rem 0.3rem; width: 100%; }
    .bench select { flex: 1 1 14rem; }
    .bench output button { font: inherit; color: var(--link); background: none; border: 0; padding: 0; text-align: left; text-decoration: underline; cursor: pointer; }
    .bench .controls { max-width: none; margin: 0; }
    .bench output { display: block; font-size: 0.95rem; min-height: 1.5em; }
    .bench code { overflow-wrap: anywhere; }
    .bench canvas { display: block; width: 100%; height: 300px; }
    .pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(18rem, 100%), 1fr)); gap: 1rem; }
    .bench p { margin: 0; font-size: 0.9rem; }
    .key { display: inline-block; margin-right: 1.2em; }
    .key::before { content: ""; display: inline-block; width: 1.3em; height: 0; margin-right: 0.4em; vertical-align: middle; border-top: 2px solid var(--of); }
    .key.dashed::before { border-top-style: dashed; }
    .key.dot::before { width: 0.6em; height: 0.6em; border: 0; border-radius: 50%; background: var(--of); }
    .key.band::before { height: 0.8em; border: 0; background: var(--of); opacity: 0.75; }
    .first { display: grid; grid-template-columns: minmax(0, 1fr) max-content; gap: 0.6rem 1.2rem; align-items: center; }
    .first .fields { max-width: 30rem; grid-template-columns: 1fr; }
    @media (max-width: 40rem) {
      .first { grid-template-columns: 1fr; }
      .bench .pair { gap: 0.3rem; }
      .bench canvas { height: 216px; }
      .bench output { min-height: 3em; }
      .lab:has(.first) { margin-top: 1rem; }
      .bench:has(> .first) { margin-top: 0; }
      .first + .pair { display: contents; }
      .first + .pair > :first-child { order: -2; }
      .bench > .first { order: -1; }
    }
    .bench details { font-size: 0.95rem; }
    .bench details > *, .bench details > .controls { margin-top: 0.8rem; }
  ` });
  document.head.append(look);

  // The module, with what it is asked and what it answers as JavaScript has it.
  let ready;
  const engine = () => (ready ??= start());
  async function start() {
    const bytes = Uint8Array.from(atob(module), (letter) => letter.charCodeAt(0));
    const { exports } = (await WebAssembly.instantiate(bytes)).instance;
    await Promise.all(["", "italic "].map((style) => document.fonts.load(`${style}15px "Libertinus Serif"`)));
    const memory = (Kind, at, length) => new Kind(exports.memory.buffer, at, length);
    const text = () => new TextDecoder().decode(memory(Uint8Array, exports.text(), exports.text_length()));
    const numbers = (length) => memory(Float64Array, exports.numbers(), length);
    const refused = (answer) => {
      if (answer === 2) throw new RangeError(text());
      return answer === 1;
    };
    return {
      open({ chain, forces, transient, window }) {
        const { stream = "", sigma, seed, realisation } = forces.drawn ?? {};
        const { masses, spacing, natural_frequency, forcing_frequency, restitution } = chain;
        const [ring, start] = [Number(chain.boundary === "ring"), ["rest", "zero", "random"].indexOf(chain.start)];
        const own = [transient, window, masses, spacing, natural_frequency, forcing_frequency, restitution, ring, start];
        own.push(...(forces.given?.flat() ?? [sigma, seed, realisation]));
        const name = new TextEncoder().encode(stream);
        exports.room(name.length, own.length);
        memory(Uint8Array, exports.text(), name.length).set(name);
        numbers(own.length).set(own);
        refused(exports.open());
      },
      advance: (impacts) => refused(exports.advance(impacts)),
      found() {
        const [time, impacts, distinct, gaps, columns] = numbers(5);
        return { time, impacts, distinct, gaps, columns, digest: text(), bytes: exports.memory.buffer.byteLength, picture: memory(Uint32Array, exports.picture(), columns * gaps) };
      },
      law(vertices, p) {
        refused(exports.law(vertices, p));
        const [k_star, mean, p_crit, p_jump, minus, plus, ...rest] = numbers(6 + 2 * vertices);
        return { k_star, mean, p_crit, p_jump, zeros: [minus, plus], probability: rest.slice(0, vertices), f: rest.slice(vertices) };
      },
      p: exports.p_of_sigma,
      mean: exports.mean,
      k_star: exports.k_star,
    };
  }

  // A run in slices, so that the page stays awake; a later one ends it.
  const SLICE = 25; // milliseconds
  let turn = 0;
  async function run(asked, passing) {
    const own = ++turn;
    const module = await engine();
    if (own !== turn) return null;
    module.open(asked);
    let since = performance.now();
    while (module.advance(500)) {
      if (performance.now() - since < SLICE) continue;
      passing(module.found());
      await new Promise((go) => setTimeout(go));
      if (own !== turn) return null;
      since = performance.now();
    }
    return module.found();
  }

  // Pictures: a frame with its axes, and what is drawn in units of the data.
  // Words between stars are in italics.
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const step = (span) => {
    const ten = 10 ** Math.floor(Math.log10(span / 3));
    return ten * [5, 2, 1].find((own) => own * ten * 2 <= span);
  };
  function plot(canvas, height, [left, right, below], [low, high, beside], told) {
    const [ratio, width] = [devicePixelRatio, canvas.clientWidth];
    canvas.style.height = `${height}px`;
    [canvas.width, canvas.height] = [width * ratio, height * ratio];
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", told);
    const c = canvas.getContext("2d");
    c.scale(ratio, ratio);
    const box = { x: 54, y: 24, width: width - 68, height: height - 68 };
    const px = (x) => box.x + (box.width * (x - left)) / (right - left);
    const py = (y) => box.y + box.height * (1 - (y - low) / (high - low));
    const ticks = (from, to) => {
      const by = step(to - from);
      const first = Math.ceil(from / by - 1e-9);
      const all = Array.from({ length: Math.floor(to / by + 1e-9) - first + 1 }, (_, i) => Number(((first + i) * by).toPrecision(6)));
      const digits = Math.max(0, -Math.floor(Math.log10(by) + 1e-9));
      return { by, from, to, all, said: (x) => x.toFixed(digits).replace("-", "−") };
    };
    // The share of the words that lies left of x is 0, 1/2 or 1.
    const write = (text, x, y, share = 0.5, name = "ink") => {
      const pieces = text.split("*").map((piece, i) => [piece, `${i % 2 ? "italic " : ""}15px ${getComputedStyle(document.body).fontFamily}`]);
      const wide = pieces.map(([piece, font]) => ((c.font = font), c.measureText(piece).width));
      c.fillStyle = colour(name);
      let at = x - share * wide.reduce((a, b) => a + b, 0);
      pieces.forEach(([piece, font], i) => ((c.font = font), c.fillText(piece, at, y), (at += wide[i])));
    };
    const floor = box.y + box.height;
    const [across, up] = [ticks(left, right), ticks(low, high)];
    const between = ({ by, from, to, all }) => Array.from({ length: all.length + 1 }, (_, i) => (all[0] ?? from) + (i - 0.5) * by).filter((x) => x >= from && x <= to);
    c.strokeStyle = colour("ink");
    c.lineWidth = 1.2;
    c.beginPath();
    [[box.x, box.y], [box.x, floor], [box.x + box.width, floor]].forEach(([x, y]) => c.lineTo(x, y));
    for (const x of across.all) (c.moveTo(px(x), floor), c.lineTo(px(x), floor + 6), write(across.said(x), px(x), floor + 21));
    for (const y of up.all) (c.moveTo(box.x, py(y)), c.lineTo(box.x - 6, py(y)), write(up.said(y), box.x - 10, py(y) + 5, 1));
    for (const x of between(across)) (c.moveTo(px(x), floor), c.lineTo(px(x), floor + 3));
    for (const y of between(up)) (c.moveTo(box.x, py(y)), c.lineTo(box.x - 3, py(y)));
    c.stroke();
    write(below, box.x + box.width / 2, height - 5);
    c.save();
    c.translate(13, box.y + box.height / 2);
    c.rotate(-Math.PI / 2);
    write(beside, 0, 0);
    c.restore();
    const inside = (draw) => (...all) => {
      c.save();
      c.beginPath();
      c.rect(box.x, 0, box.width, floor);
      c.clip();
      draw(...all);
      c.restore();
    };
    const drawn = {
      words: (text, x, y, name) => write(text, px(x), py(y) - 5, 0.5, name),
      image(source) {
        c.imageSmoothingEnabled = source.height > box.height;
        c.drawImage(source, box.x, box.y, box.width, box.height);
      },
      band(points, name, alpha = 0.75) {
        [c.fillStyle, c.globalAlpha] = [colour(name), alpha];
        c.beginPath();
        points.forEach(([x, , high]) => c.lineTo(px(x), py(high)));
        points.toReversed().forEach(([x, low]) => c.lineTo(px(x), py(low)));
        c.fill();
      },
      line(points, name, dash = []) {
        [c.strokeStyle, c.lineWidth] = [colour(name), 2];
        c.setLineDash(dash);
        c.beginPath();
        points.forEach(([x, y]) => c.lineTo(px(x), py(y)));
        c.stroke();
      },
      columns(heights, name) {
        [c.strokeStyle, c.lineWidth] = [colour(name), Math.max(1, (0.6 * box.width) / (right - left))];
        c.beginPath();
        heights.forEach((y, i) => (c.moveTo(px(i + 1), py(0)), c.lineTo(px(i + 1), py(y))));
        c.stroke();
      },
      marks(points, name, radius) {
        c.fillStyle = colour(name);
        points.forEach(([x, y]) => (c.beginPath(), c.arc(px(x), py(y), radius, 0, 7), c.fill()));
      },
    };
    return Object.fromEntries(Object.entries(drawn).map(([name, draw]) => [name, inside(draw)]));
  }
  function impacts({ picture, columns, gaps }) {
    const sheet = make("canvas", { width: columns, height: gaps });
    const image = new ImageData(columns, gaps);
    const [r, g, b] = colour("ink").match(/\w\w/g).map((pair) => parseInt(pair, 16));
    picture.forEach((count, i) => {
      const above = (gaps - 1 - Math.floor(i / columns)) * columns + (i % columns);
      if (count > 0) image.data.set([r, g, b, Math.min(255, 130 + 25 * count)], 4 * above);
    });
    sheet.getContext("2d").putImageData(image, 0, 0);
    return sheet;
  }

  const rich = (text) => text.split("*").map((piece, i) => (i % 2 ? make("em", {}, piece) : piece));

  // Numbers that a reader sets: by a slider, or typed within wider bounds.
  const tall = (height) => (innerWidth < 640 ? 0.72 * height : height);
  const said = (number) => number.toLocaleString("en", { maximumSignificantDigits: 4 });
  function field({ name, title, unit = "", slider: [low, high], step, whole = false, bounds, value }, changed) {
    const range = make("input", { type: "range", id: `lab-${name}`, min: low, max: high, step, value });
    const typed = make("input", { type: "number", min: bounds[0], max: bounds[1], step: whole ? 1 : "any", value });
    typed.setAttribute("aria-label", `${title.replaceAll("*", "")}, typed`);
    const node = make("div", {}, make("label", { htmlFor: range.id }, ...rich(unit ? `${title} (${unit})` : title)), range, typed);
    range.addEventListener("input", () => changed((typed.value = range.value)));
    typed.addEventListener("input", () => changed((range.value = typed.value)));
    return {
      node,
      get() {
        const own = typed.valueAsNumber;
        if (own >= bounds[0] && own <= bounds[1] && (!whole || Number.isInteger(own))) return own;
        throw new RangeError(`${title.replaceAll("*", "")} = ${typed.value || "nothing"} is not allowed; give a ${whole ? "whole " : ""}number from ${bounds[0]} to ${bounds[1]}.`);
      },
      set: (own) => (range.value = typed.value = own),
    };
  }
  function fields(list, changed) {
    const all = Object.fromEntries(list.map((one) => [one.name, field(one, changed)]));
    return {
      node: make("div", { className: "fields" }, ...Object.values(all).map((one) => one.node)),
      get: () => Object.fromEntries(Object.entries(all).map(([name, one]) => [name, one.get()])),
      set: (values) => Object.entries(values).forEach(([name, value]) => all[name].set(value)),
    };
  }
  const SIGMAS = Array.from({ length: 161 }, (_, i) => i / 400);
  const keys = (...names) => make("p", {}, ...names.map(([name, text, kind = ""]) => {
    const node = make("span", { className: `key ${kind}` }, ...rich(text));
    node.style.setProperty("--of", `var(--${name})`);
    return node;
  }));

  function chain(bench) {
    const base = runs[0].asked;
    const first = { ...base.forces.drawn, T: base.transient, W: base.window, r: base.chain.restitution, n: base.chain.masses };
    const own = fields([{ name: "sigma", title: "force *σ*", unit: "*dω*²", slider: [0, 0.3], step: 0.0025, bounds: [0, 1], value: first.sigma }], () => update());
    const more = fields([
      { name: "n", title: "masses *n*", slider: [1, 1000], step: 1, whole: true, bounds: [1, 1000], value: first.n },
      { name: "r", title: "restitution *r*", slider: [0, 1], step: 0.01, bounds: [0, 1], value: first.r },
      { name: "T", title: "transient *T*", unit: "1/*ω*", slider: [0, 2000], step: 10, bounds: [0, 10000], value: first.T },
      { name: "W", title: "window *W*", unit: "1/*ω*", slider: [10, 1000], step: 10, bounds: [1, 10000], value: first.W },
      { name: "realisation", title: "realisation", slider: [0, 999], step: 1, whole: true, bounds: [0, 1e9], value: 0 },
      { name: "seed", title: "seed", slider: [1, 9999], step: 1, whole: true, bounds: [0, 2 ** 53], value: first.seed },
    ], () => update());
    const choice = make("select", { ariaLabel: "Runs of this edition" }, make("option", { value: "", textContent: "your settings" }),
      ...runs.map(({ name }, i) => make("option", { value: i, textContent: name })));
    const other = make("button", { type: "button", textContent: "Another chain" });
    const beside = make("div", { className: "controls" }, other);
    const [told, proof] = [make("output"), make("output")];
    const [where, curves] = [make("canvas"), make("canvas")];
    bench.append(
      make("div", { className: "first" }, own.node, beside), make("div", { className: "pair" }, where, curves), told, proof,
      keys(["red", "your chains, the last one large", "dot"], ["ink", `mean of all chains (*n* = ${first.n}, *r* = ${first.r}, *T* = ${first.T}, *W* = ${first.W})`],
        ["pale", "nine chains in ten", "band"], ["grey", "mean of those with an impact", "dashed"], ["green", "theory for your *n*"]),
      make("details", {}, make("summary", {}, "Masses, restitution, times, seed; runs of this edition to repeat"), more.node, make("div", { className: "controls" }, choice)));

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

    // Runs that differ in nothing but σ, seed and realisation are shown together.
    const KEPT = 500;
    let [points, alike, theory] = [[], "", []];
    async function show(asked) {
      const { transient: from, window, chain, forces } = asked;
      const until = from + window;
      const draw = (found, state) => {
        told.replaceChildren(...rich(`${found.distinct} of ${found.gaps} gaps have impacts from *t* = ${said(from)} to ${said(until)}; impacts in all: ${found.impacts.toLocaleString("en")}${state}.`));
        const picture = plot(where, tall(300), [0, until, "time *t* (1/*ω*)"], [0, found.gaps, "gap"], `Gap against time, a mark for each impact. ${told.textContent}`);
        picture.band([[from, 0, found.gaps], [until, 0, found.gaps]], "orange", 0.35);
        picture.words("counted", from + window / 2, found.gaps, "orange");
        picture.image(impacts(found));
        if (found.impacts === 0 && state === "") picture.words("no impact", until / 2, found.gaps / 2);
      };
      const known = runs.find((one) => JSON.stringify(one.asked) === JSON.stringify(asked));
      const began = performance.now();
      proof.replaceChildren();
      const found = await run(asked, (found) => draw(found, `, so far to *t* = ${said(found.time)}`));
      if (!found) return;
      draw(found, "");
      Object.assign(bench.dataset, { time: performance.now() - began, digest: found.digest, bytes: found.bytes });
      if (known) {
        const same = known.found.digest === found.digest;
        const eight = ({ digest }) => make("code", { textContent: digest.slice(0, 8), title: digest });
        proof.append(make("strong", { textContent: same ? "✓ same bits" : "✗ NOT the same bits" }), " as this edition: SHA-256 of all impacts ", eight(found));
        if (!same) proof.append(", here; there ", eight(known.found));
      }
      if (found.impacts === 0) proof.append(known ? ". " : "", "No impact: neighbours never swing so differently that the gap between them, of width d, closes. ");
      if (!known && forces.drawn) {
        const near = nearest(asked);
        const offer = make("button", { type: "button", textContent: runs[near].name });
        offer.addEventListener("click", () => repeat(near));
        proof.append("This edition has no digest for these settings; the nearest run with one: ", offer);
      }
      if (!forces.drawn) return;
      const { masses: n, restitution: r } = chain;
      if (alike !== (alike = [n, r, from, window].join())) {
        const module = await engine();
        points = [];
        theory = SIGMAS.map((sigma) => [sigma, module.mean(n + 1, module.p(sigma)) / (n + 1)]);
      }
      points.push([forces.drawn.sigma, found.distinct / found.gaps]);
      points = points.slice(-KEPT);
      const rows = (which) => curve.rows.map((row) => [row[0], row[which] / curve.gaps]);
      const last = points.at(-1);
      const picture = plot(curves, tall(300), [0, Math.max(0.3, last[0]), "*σ* (*dω*²)"], [0, 1.05, "share of gaps with impacts"],
        `Share of gaps with impacts against σ: the means of this edition, the theory, and your runs; the last, at σ = ${last[0]}, has ${said(last[1])}.`);
      picture.band(curve.rows.map(([sigma, , , low, high]) => [sigma, low / curve.gaps, high / curve.gaps]), "pale");
      picture.line(theory, "green");
      picture.line(rows(2), "grey", [5, 4]);
      picture.line(rows(1), "ink");
      // Each name is beside its curve, where that rises.
      const beyond = (line, share) => (line.find(([, y]) => y > share) ?? [0.3])[0];
      picture.words("theory", beyond(theory, 0.5) + 0.032, 0.5, "green");
      picture.words("simulation", beyond(rows(1), 0.85) - 0.05, 0.85);
      picture.marks(points, "red", 2.5);
      picture.marks([last], "red", 5);
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
    const update = () => guarded(() => {
      const { sigma, n, r, T, W, seed, realisation } = { ...own.get(), ...more.get() };
      const drawn = { ...base.forces.drawn, sigma, seed, realisation };
      const asked = { ...base, chain: { ...base.chain, masses: n, restitution: r }, forces: { drawn }, transient: T, window: W };
      const known = runs.findIndex((one) => JSON.stringify(one.asked) === JSON.stringify(asked));
      choice.value = known < 0 ? "" : known;
      return asked;
    });
    const repeat = (i) => guarded(() => {
      const { asked } = runs[i];
      choice.value = i;
      const { sigma, seed, realisation } = asked.forces.drawn ?? first;
      own.set({ sigma });
      more.set({ seed, realisation, n: asked.chain.masses, r: asked.chain.restitution, T: asked.transient, W: asked.window });
      return asked;
    });
    choice.addEventListener("change", () => choice.value && repeat(Number(choice.value)));
    other.addEventListener("click", () => {
      more.set({ realisation: (more.get().realisation + 1) % 1000 });
      update();
    });
    return update;
  }

  function theory(bench) {
    const own = fields([
      { name: "p", title: "probability *p*", slider: [0, 0.06], step: 0.0001, bounds: [0, 1], value: 0.013 },
      { name: "N", title: "vertices *N*", slider: [4, 1000], step: 1, whole: true, bounds: [4, 1000], value: 100 },
    ], () => update());
    const told = make("output");
    const all = Array.from({ length: 4 }, () => make("canvas"));
    bench.append(own.node, told, make("div", { className: "pair" }, ...all),
      keys(["green", "*P*(*X* = *k*), and *μ*"], ["blue", "*f*"], ["red", "*k*∗, and the chosen *p*", "dot"], ["ink", "simulation of this edition"]));
    const END = 0.06;
    async function show({ p, N }) {
      const module = await engine();
      const { k_star, mean, p_crit, p_jump, zeros, probability, f } = module.law(N, p);
      told.textContent = `k* = ${k_star}, μ = ${said(mean)}. k* leaves 1 at p = ${said(p_jump)}; f touches zero at p = ${said(p_crit)}.`;
      const top = 1.05 * Math.max(...probability);
      const columns = plot(all[0], 240, [0, N + 1, "*k*"], [0, top, "*P*(*X* = *k*)"], `P(X = k) over k: k* = ${k_star}, mean ${said(mean)}.`);
      columns.columns(probability, "green");
      columns.marks([[k_star, probability[k_star - 1]]], "red", 4);
      // As far as f is not yet far below zero.
      const shown = Math.min(N, Math.max(20, Math.ceil(1.5 * zeros[1])));
      const near = f.slice(0, shown);
      const high = Math.max(1, 1.1 * Math.max(...near));
      const sign = plot(all[1], 240, [0, shown, "*k*"], [-high, high, "*f*(*k*)"], zeros[0] < 0 ? "f over k: below zero everywhere." : `f over k: above zero from ${said(zeros[0])} to ${said(zeros[1])}.`);
      sign.line([[0, 0], [shown, 0]], "grey");
      sign.line(near.map((y, i) => [i + 1, y]), "blue");
      const end = Math.max(END, p);
      const along = Array.from({ length: 241 }, (_, i) => (end * i) / 240);
      const against = plot(all[2], 240, [0, end, "*p*"], [0, 1.05 * N, "*k*∗ and *μ*"], "k* and μ against p.");
      against.line(along.map((p) => [p, module.k_star(N, p)]), "red");
      against.line(along.map((p) => [p, module.mean(N, p)]), "green");
      against.marks([[p, k_star], [p, mean]], "red", 4);
      // The σ of this p, by halving: p rises with σ.
      let [low, up] = [0, 1];
      for (let i = 0; i < 40; i += 1) [low, up] = module.p((low + up) / 2) < p ? [(low + up) / 2, up] : [low, (low + up) / 2];
      const beside = plot(all[3], 240, [0, 0.4, "*σ* (*dω*²)"], [0, 1.05, "*μ*/*N*"], `μ/N against σ, beside the simulation; p = ${p} belongs to σ = ${said(up)}.`);
      beside.line(SIGMAS.map((sigma) => [sigma, module.mean(N, module.p(sigma)) / N]), "green");
      beside.line(curve.rows.map(([sigma, , kept]) => [sigma, kept / curve.gaps]), "ink");
      beside.marks([[up, mean / N]], "red", 4);
    }
    const update = async () => {
      try {
        await show(own.get());
      } catch (error) {
        if (!(error instanceof RangeError)) throw error;
        told.textContent = error.message;
      }
    };
    return update;
  }

  const LABS = { chain, theory };
  return async (figure, asked) => {
    const bench = make("div", { className: "bench" });
    const update = LABS[figure.dataset.lab](bench);
    figure.querySelector(".controls").replaceWith(bench);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", update);
    addEventListener("resize", update);
    await update();
    if (asked) bench.querySelector("input").focus();
  };
})();
