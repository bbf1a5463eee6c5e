/* Films as single frames on one or several screens, all on the same time line. */
(function () {
  const host = document.getElementById("replay");
  if (!host) return;
  const slider = document.getElementById("time"), clock = document.getElementById("clock"), play = document.getElementById("play");
  const screens = [...host.querySelectorAll("img.screen")], length = Number(slider.max);
  const list = document.getElementById("events"), needle = document.getElementById("needle"), events = [...list.children];
  const times = events.map(item => Number(item.firstElementChild.dataset.time));
  const STEP = 0.25, HAIR = 1e-3;
  let timer = null, now = 0;
  // The latest entry that is not after a time; -1 where all are.
  function latest(count, at, time) {
    let low = -1, high = count - 1;
    while (low < high) { const middle = (low + high + 1) >> 1; if (at(middle) <= time + HAIR) low = middle; else high = middle - 1; }
    return low;
  }
  function show(time) {
    // The slider's steps are coarser than the times of events, so that it does not keep the time.
    now = Math.max(0, Math.min(length, time));
    slider.value = now;
    slider.setAttribute("aria-valuetext", `${now.toFixed(1)} seconds`);
    clock.textContent = `${now.toFixed(1)} of ${length.toFixed(1)} s`;
    needle.style.left = `${100 * now / length}%`;
    for (const screen of screens) {
      const frames = data.tracks[Number(screen.dataset.track)].frames;
      if (frames.length) screen.src = pictures[frames[Math.max(0, latest(frames.length, i => frames[i].time, now))].key];
    }
    const current = latest(times.length, i => times[i], now);
    events.forEach((item, index) => item.classList.toggle("now", index === current));
    if (current >= 0) list.scrollTop = events[current].offsetTop - list.offsetTop - list.clientHeight / 2;
  }
  function stop() { clearInterval(timer); timer = null; play.textContent = "▶"; }
  function start() {
    let time = now >= length - 0.05 ? 0 : now;
    let last = performance.now();
    play.textContent = "❚❚";
    timer = setInterval(() => {
      const moment = performance.now();
      time += (moment - last) / 1000; last = moment;
      if (time >= length) { show(length); stop(); } else show(time);
    }, 50);
  }
  const turn = () => timer ? stop() : start();
  const go = time => { stop(); show(time); };
  play.addEventListener("click", turn);
  slider.addEventListener("input", () => go(Number(slider.value)));
  slider.addEventListener("keydown", event => {
    const next = times.find(time => time > now + HAIR), last = times.findLast(time => time < now - HAIR);
    const done = { " ": turn, ArrowRight: () => go(now + STEP), ArrowUp: () => go(now + STEP), ArrowLeft: () => go(now - STEP), ArrowDown: () => go(now - STEP),
      PageDown: () => go(next ?? length), PageUp: () => go(last ?? 0), Home: () => go(0), End: () => go(length) }[event.key];
    if (done) { event.preventDefault(); done(); }
  });
  for (const place of document.querySelectorAll("[data-time]")) place.addEventListener("click", () => go(Number(place.dataset.time)));
  show(0);
})();
