// Adds to a page: cards of numbers, previews of what is referred to, a search, filters.

const all = (what, within = document) => [...within.querySelectorAll(what)];
const make = (tag, properties = {}, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};

// A page on a disk can load nothing but scripts, which are loaded when they are first needed.
const load = (src) => new Promise((onload, onerror) => document.head.append(make("script", { src, onload, onerror })));
let POINTS_READY;
const phone = matchMedia("(max-width: 40rem)");
// Tables with more rows than this are filtered.
const LONG = 40;

