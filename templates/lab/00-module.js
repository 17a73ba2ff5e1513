// What readers run themselves: chains by the engine of this report, circuits by its theory, in
// WebAssembly. A page loads this when it is first asked to; what it has to hold the runs against is
// LAB, which the program writes before this.
const { runs, curve, protocols, jumps, module: BYTES } = LAB;

const make = (tag, properties = {}, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};

// The module, with what it is asked and what it answers as JavaScript has it. Each copy has a
// memory of its own: one for the chain that is shown, one for its masses in motion, one for many.
const compiled = {};
async function start() {
  const bytes = (compiled.bytes ??= Uint8Array.from(atob(BYTES), (letter) => letter.charCodeAt(0)));
  const { exports } = await WebAssembly.instantiate(await (compiled.code ??= WebAssembly.compile(bytes)));
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
    // Positions of all masses at a time that is not before the last, and the gaps hit meanwhile.
    follow(time, masses) {
      refused(exports.follow(time));
      const hits = numbers(masses + 1)[masses];
      const all = [...numbers(masses + 1 + hits)];
      return { positions: all.slice(0, masses), hit: all.slice(masses + 1) };
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
let ready;
const fonts = () => Promise.all(["", "italic "].map((style) => document.fonts.load(`${style}15px "Libertinus Serif"`)));
const engine = () => (ready ??= fonts().then(start));

// Runs are cut in slices, so that the page stays awake.
const SLICE = 25; // milliseconds
const breath = () => new Promise((go) => setTimeout(go));

// The chain that is shown: a later one ends it.
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
    await breath();
    if (own !== turn) return null;
    since = performance.now();
  }
  return module.found();
}
