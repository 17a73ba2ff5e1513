"use strict";
// Where the masses are, in closed form from their last event, and a player that shows it.
{
  const figure = document.getElementById("scene");
  const all = (what) => [...figure.querySelectorAll(what)];
  const [data] = all("script[type='application/json']");
  const { rates, from, until, scale, bodies, impacts, bar } = JSON.parse(data.textContent);
  const [omega, Omega] = rates;
  const SPEED = 2; // units of time a second
  const FADE = 1; // units of time that an impact is lit

  const position = ({ rest, forced, free }, t) => {
    const [, a, b] = free.findLast(([since]) => since <= t) ?? free[0];
    const [c, s] = forced;
    return rest + a * Math.cos(omega * t) + b * Math.sin(omega * t) + c * Math.cos(Omega * t) + s * Math.sin(Omega * t);
  };
  figure.positions = (t) => bodies.map((body) => position(body, t));

  const [masses, lights, bars] = [all(".masses rect"), all(".lights line"), all(".counts .now")];
  const [controls, button, slider, words] = [".controls", ".controls button", ".controls input", ".controls span"].map((what) => all(what)[0]);
  const first = masses.map((mass) => Number(mass.getAttribute("x")));
  const place = (k, t) => first[k] + scale * (position(bodies[k], t) - position(bodies[k], from));
  let time = from;
  let frame = null;

  function show(t) {
    time = Math.min(t, until);
    masses.forEach((mass, k) => mass.setAttribute("x", place(k, time).toFixed(1)));
    const past = impacts.filter(([when]) => when <= time);
    lights.forEach((light, gap) => {
      const own = past.filter(([, where]) => where === gap);
      const last = own.length > 0 ? own.at(-1)[0] : -Infinity;
      bars[gap].setAttribute("height", bar * own.length);
      light.setAttribute("opacity", Math.max(0, 1 - (time - last) / FADE).toFixed(2));
      if (own.length > 0) for (const end of ["x1", "x2"]) light.setAttribute(end, place(gap + 1, last).toFixed(1));
    });
    slider.value = time;
    words.textContent = `t = ${time.toFixed(1)}, impacts: ${past.length}`;
    slider.setAttribute("aria-valuetext", words.textContent);
  }

  function play(on) {
    cancelAnimationFrame(frame);
    frame = null;
    button.textContent = on ? "Pause" : "Play";
    if (!on) return;
    if (time >= until) show(from);
    let before = null;
    const step = (now) => {
      // A page that was hidden goes on where it was.
      show(time + (SPEED * Math.min(now - (before ?? now), 100)) / 1000);
      before = now;
      if (time >= until) play(false);
      else frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
  }

  // Who prefers no motion goes through time by hand.
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const obey = () => {
    button.hidden = calm.matches;
    if (calm.matches) play(false);
  };
  calm.addEventListener("change", obey);
  button.addEventListener("click", () => play(frame === null));
  slider.addEventListener("input", () => {
    play(false);
    show(Number(slider.value));
  });
  obey();
  show(from);
  controls.hidden = false;
}
