// What this edition computed beforehand for the paper's chain: the rise for each transient and
// window, of which the main sweep has most chains; and where the most likely number jumps.

// The first run is at the σ that the paper prints for the threshold.
const base = runs[0].asked;
const printed = base.forces.drawn.sigma;
const distinct = (numbers) => [...new Set(numbers)].sort((a, b) => a - b);
const TRANSIENTS = distinct(protocols.map(({ protocol }) => protocol.transient));
const WINDOWS = distinct(protocols.map(({ protocol }) => protocol.window));
const SIGMAS = Array.from({ length: 161 }, (_, i) => i / 400);

/** A value with its standard error in units of the last digit: 0.1159(3). */
function bracketed({ value, error }) {
  const digits = Math.max(0, -Math.floor(Math.log10(error * 1.05)));
  return `${value.toFixed(digits)}(${Math.round(error * 10 ** digits)})`;
}

/** Words for a chain and its times. */
const settings = ({ chain, transient, window }) => `n = ${chain.masses}, r = ${chain.restitution}, T = ${transient}, W = ${window}`;

// Where fewer chains than this have an impact, the mean of these is one of few chains.
const ENOUGH = 0.25;

/** The means of all chains and of those with an impact, and of these where they are few, as points of σ and share. */
function lines(rows) {
  const points = (which, rows) => rows.filter((row) => row[which] !== null).map((row) => [row[0], row[which] / curve.gaps]);
  const first = rows.findIndex(([, all, hit]) => hit > 0 && all >= ENOUGH * hit);
  return { all: points(1, rows), hit: points(2, rows.slice(Math.max(0, first))), few: points(2, rows.slice(0, first + 1)) };
}

// The rises of the shortest and of the longest wait that have a half height.
const by_half = protocols.filter(({ half }) => half).sort((a, b) => b.half.value - a.half.value);
const WAITS = [[by_half[0], "short wait"], [by_half.at(-1), "long wait"]].map(([{ rows, half, protocol }, name]) => ({ name, protocol, half, ...lines(rows) }));

/**
 * The curves for the times of a run, or for those that are nearest, as points of σ and share; where
 * the mode jumps; and whether all of it holds for the chain and its times.
 */
function computed({ chain, transient, window }) {
  const far = ({ protocol }) => Math.abs(Math.log((protocol.transient + 1) / (transient + 1))) + Math.abs(Math.log(protocol.window / window));
  const nearest = protocols.reduce((best, one) => (far(one) < far(best) ? one : best));
  const { protocol } = nearest;
  const same = (one) => one.protocol.transient === protocol.transient && one.protocol.window === protocol.window;
  const is_main = protocol.transient === base.transient && protocol.window === base.window;
  const { rows, half } = is_main ? curve : nearest;
  const holds = far(nearest) === 0 && JSON.stringify(chain) === JSON.stringify(base.chain);
  return {
    ...lines(rows),
    band: rows.filter((row) => row[1] !== null).map(([sigma, , , low, high]) => [sigma, low / curve.gaps, high / curve.gaps]),
    half,
    end: rows.findLast((row) => row[1] !== null)[0],
    jump: jumps.find(same),
    holds,
    label: settings({ ...base, ...protocol }),
    protocol,
  };
}

/** What the curves say, in a sentence or two. */
function finding({ half, end, jump, holds, label, protocol: { transient, window } }) {
  if (!holds) return `The faint curves are for ${label}; for your settings we have none.`;
  const times = `At *T* = ${transient} and *W* = ${window}`;
  const place = half ? `rises past half of all gaps at *σ* = ${bracketed(half)}` : "passes half of all gaps near the least *σ* that we ran";
  const mode = {
    true: () => ` The most likely number jumps to all gaps at ${bracketed(jump.sigma)}.`,
    false: () => " The most likely number climbs to all gaps without a jump.",
    null: () => " Whether the most likely number jumps, our sample does not tell.",
  };
  const until = end < 0.3 ? ` The curves are computed up to *σ* = ${end}.` : "";
  return `${times} the mean of our chains with an impact ${place}; the paper prints ${printed}, and no times.${jump ? mode[jump.jumps]() : ""}${until}`;
}
