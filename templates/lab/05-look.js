// How labs look.

document.head.append(make("style", { textContent: `
  .bench { display: grid; grid-template-columns: minmax(0, 1fr); gap: 0.5rem; margin-top: 0.8rem; max-width: 58rem; }
  .fields { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(17rem, 100%), 1fr)); gap: 0.4rem 2rem; }
  .fields > div { display: grid; grid-template-columns: 7.5rem 1fr 5.5rem; gap: 0.6rem; align-items: center; font-size: 0.95rem; line-height: 1.2; }
  .bench input, .bench select { font: inherit; color: inherit; accent-color: var(--link); min-width: 0; }
  .bench input[type=range] { min-height: 1.5rem; }
  .bench input[type=number], .bench select { background: var(--soft); border: 1px solid var(--grey); border-radius: 4px; padding: 0.15rem 0.3rem; width: 100%; }
  .bench select { flex: 1 1 14rem; }
  .bench output button { font: inherit; color: var(--link); background: none; border: 0; padding: 0; text-align: left; text-decoration: underline; cursor: pointer; }
  .bench .controls { max-width: none; margin: 0; }
  .bench .controls button { min-width: 0; }
  .pair .controls { margin-top: 0.5rem; }
  .bench output { display: block; font-size: 0.95rem; min-height: 1.5em; }
  .bench .controls output { flex: 1 1 12rem; }
  .bench :is(code, .controls a) { overflow-wrap: anywhere; }
  .bench canvas { display: block; width: 100%; height: 300px; }
  .bench p { margin: 0; font-size: 0.9rem; }
  .bench progress { accent-color: var(--blue); width: 9rem; }
  .bench details { font-size: 0.95rem; }
  .bench details > *, .bench details > .controls { margin-top: 0.8rem; }
  .pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(18rem, 100%), 1fr)); gap: 1rem; }
  .pair output { margin: 0.3rem 0 0; }

  /* The moment that is seen in motion. */
  .place { position: relative; }
  .cursor { position: absolute; width: 0; border-left: 1.5px solid var(--blue); pointer-events: none; }

  /* What a line or a mark means. */
  .key { display: inline-block; margin-right: 1.2em; }
  .key::before { content: ""; display: inline-block; width: 1.3em; height: 0; margin-right: 0.4em; vertical-align: middle; border-top: 2px solid var(--of); }
  .key[hidden] { display: none; }
  .key.dashed::before { border-top-style: dashed; }
  .key.dotted::before { border-top-style: dotted; }
  .key.dot::before { width: 0.6em; height: 0.6em; border: 0; border-radius: 50%; background: var(--of); }
  .key.band::before { height: 0.8em; border: 0; background: var(--of); opacity: 0.75; }
  .key.peak::before { width: 0; border: 0.35em solid transparent; border-top: 0; border-bottom: 0.6em solid var(--of); }

  /* The slider of the force, and what acts on the one chain. */
  .first { display: grid; grid-template-columns: minmax(0, 1fr) max-content; gap: 0.6rem 1.2rem; align-items: center; }
  .first .fields:first-child { max-width: 34rem; grid-template-columns: 1fr; }
  .first .fields:last-child { grid-column: 1 / -1; }

  /* Some of the masses, moving. */
  .bench .row canvas { height: 84px; }
  .row { display: grid; gap: 0.1rem; }
  .row .controls { font-size: 0.9rem; gap: 0.2rem 0.8rem; }
  .row button { padding: 0.05rem 0.6rem; }
  .row .controls span { flex: 1 1 10rem; min-width: 0; }

  @media (max-width: 40rem) {
    .first { grid-template-columns: minmax(0, 1fr); gap: 0.4rem; }
    .first .controls { order: 1; }
    .bench .pair { gap: 0.3rem; }
    .bench canvas { height: 216px; }
    .bench .row canvas { height: 70px; }
    .bench output { min-height: 3em; }
    .bench .controls output { min-height: 0; }
  }
` }));
