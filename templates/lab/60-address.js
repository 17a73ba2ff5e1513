// The settings in the address of the page, `#chain:sigma=0.1&T=1000`, and as a command line.

const ALWAYS = ["sigma", "T", "W"];

/** The part of the address that says the force, the times, and what differs from the first settings. */
function fragment(lab, values, first) {
  const own = Object.entries(values).filter(([name, value]) => ALWAYS.includes(name) || value !== first[name]);
  return `#${lab}:${new URLSearchParams(own)}`;
}

/** The settings that an address says, with the first ones for all others; none if it says none. */
function from_address(lab, first) {
  if (!location.hash.startsWith(`#${lab}:`)) return undefined;
  const said = new URLSearchParams(location.hash.slice(lab.length + 2));
  const value = (name) => (said.has(name) && Number.isFinite(Number(said.get(name))) ? Number(said.get(name)) : first[name]);
  return Object.fromEntries(Object.keys(first).map((name) => [name, value(name)]));
}

/** The command that counts the gaps of the same chain. */
function command({ chain, forces: { drawn }, transient, window }) {
  if (!drawn) return "";
  const plain = base.chain;
  const options = [
    ["sigma", drawn.sigma],
    ["realisations", `${drawn.realisation}..${drawn.realisation + 1}`],
    ["masses", chain.masses, plain.masses],
    ["restitution", chain.restitution, plain.restitution],
    ["boundary", chain.boundary, plain.boundary],
    ["initial", chain.start, plain.start],
    ["transient", transient],
    ["window", window],
    ["seed", drawn.seed, base.forces.drawn.seed],
  ];
  const own = options.filter(([, value, usual]) => value !== usual);
  return `impact-paper sweep ${own.map(([name, value]) => `--${name} ${value}`).join(" ")}`;
}

/** Copies text, or selects it in sight where a page may not copy; says which on the button. */
async function copy(node, text, source) {
  const copied = await navigator.clipboard?.writeText(text).then(() => true, () => false);
  if (!copied) source.closest("details").open = true;
  getSelection().selectAllChildren(source);
  node.textContent = copied ? "Copied" : "Selected";
}

/** The link and the command of what is shown. */
function shared() {
  const [link, line] = [make("a"), make("code")];
  const copy_link = button("Copy link", () => copy(copy_link, link.href, link));
  const copy_line = button("Copy command", () => copy(copy_line, line.textContent, line));
  const row_of_line = make("div", { className: "controls" }, copy_line, line);
  const node = make("div", {}, make("div", { className: "controls" }, link), row_of_line);
  return {
    node,
    copy_link,
    show(hash, asked) {
      link.href = hash;
      link.textContent = link.href;
      line.textContent = command(asked);
      row_of_line.hidden = line.textContent === "";
      [copy_link.textContent, copy_line.textContent] = ["Copy link", "Copy command"];
    },
  };
}
