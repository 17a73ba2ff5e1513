// What a page calls to put a lab into a figure.

const LABS = { chain, theory };
globalThis.open_lab = async (figure, asked) => {
  const bench = make("div", { className: "bench" });
  const { begin, draw } = LABS[figure.dataset.lab](bench);
  figure.querySelector(".controls").replaceWith(bench);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  addEventListener("resize", draw);
  await begin();
  if (asked) bench.querySelector("input").focus();
};
