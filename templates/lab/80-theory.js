// Circuits of the theory: their distribution, the sign of f, and the jump, for any N and p.

function theory(bench) {
  const own = fields([
    { name: "p", title: "probability *p*", slider: [0, 0.06], step: 0.0001, bounds: [0, 1], value: 0.013 },
    { name: "N", title: "vertices *N*", slider: [4, 1000], step: 1, whole: true, bounds: [4, 1000], value: 100 },
  ], () => update());
  const told = make("output");
  const all = Array.from({ length: 4 }, () => make("canvas"));
  bench.append(own.node, told, make("div", { className: "pair" }, ...all),
    keys(["green", "*P*(*X* = *k*), and *μ*"], ["purple", "*k*∗"], ["ink", "*f*"], ["blue", "your *p*", "dot"], ["red", "mean of chains with an impact (*n* = 100)"]));
  const END = 0.06;
  async function show({ p, N }) {
    const module = await engine();
    const { k_star, mean, p_crit, p_jump, zeros, probability, f } = module.law(N, p);
    told.textContent = `k* = ${k_star}, μ = ${said(mean)}. k* leaves 1 at p = ${said(p_jump)}; f touches zero at p = ${said(p_crit)}.`;
    const top = 1.05 * Math.max(...probability);
    const columns = plot(all[0], 240, [0, N + 1, "*k*"], [0, top, "*P*(*X* = *k*)"], `P(X = k) over k: k* = ${k_star}, mean ${said(mean)}.`);
    columns.columns(probability, "green");
    columns.marks([[k_star, probability[k_star - 1]]], "purple", 4);
    // As far as f is not yet far below zero.
    const shown = Math.min(N, Math.max(20, Math.ceil(1.5 * zeros[1])));
    const near = f.slice(0, shown);
    const high = Math.max(1, 1.1 * Math.max(...near));
    const sign = plot(all[1], 240, [0, shown, "*k*"], [-high, high, "*f*(*k*)"], zeros[0] < 0 ? "f over k: below zero everywhere." : `f over k: above zero from ${said(zeros[0])} to ${said(zeros[1])}.`);
    sign.line([[0, 0], [shown, 0]], "grey");
    sign.line(near.map((y, i) => [i + 1, y]), "ink");
    const end = Math.max(END, p);
    const along = Array.from({ length: 241 }, (_, i) => (end * i) / 240);
    const against = plot(all[2], 240, [0, end, "*p*"], [0, 1.05 * N, "*k*∗ and *μ*"], "k* and μ against p.");
    against.line(along.map((p) => [p, module.k_star(N, p)]), "purple");
    against.line(along.map((p) => [p, module.mean(N, p)]), "green");
    against.marks([[p, k_star], [p, mean]], "blue", 4);
    // The σ of this p, by halving: p rises with σ.
    let [low, up] = [0, 1];
    for (let i = 0; i < 40; i += 1) [low, up] = module.p((low + up) / 2) < p ? [(low + up) / 2, up] : [low, (low + up) / 2];
    const beside = plot(all[3], 240, [0, 0.4, "*σ* (*dω*²)"], [0, 1.05, "*μ*/*N*"], `μ/N against σ, beside the simulation; p = ${p} belongs to σ = ${said(up)}.`);
    beside.line(SIGMAS.map((sigma) => [sigma, module.mean(N, module.p(sigma)) / N]), "green");
    beside.line(lines(curve.rows).hit, "red");
    beside.marks([[up, mean / N]], "blue", 4);
  }
  const update = async () => {
    try {
      await show(own.get());
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      told.textContent = error.message;
    }
  };
  return { begin: update, draw: update };
}
