/* A film as single frames on one or several screens, all on the same time line. */
(function () {
  const host = document.getElementById("replay");
  if (!host) return;
  const slider = document.getElementById("time"), clock = document.getElementById("clock"), play = document.getElementById("play");
  const screens = [...host.querySelectorAll("img.screen")], length = Number(slider.max);
  const events = [...host.querySelectorAll("#events li")];
  let timer = null;
  const latest = (frames, time) => {
    let low = 0, high = frames.length - 1;
    while (low < high) { const middle = (low + high + 1) >> 1; if (frames[middle].time <= time + 1e-6) low = middle; else high = middle - 1; }
    return frames[low];
  };
  function show(time) {
    slider.value = time;
    clock.textContent = `${Number(time).toFixed(1)} of ${length.toFixed(1)} s`;
    for (const screen of screens) {
      const frames = data.tracks[Number(screen.dataset.track)].frames;
      if (frames.length) screen.src = pictures[latest(frames, time).key];
    }
    let now = null;
    for (const item of events) { item.classList.remove("now"); if (Number(item.firstElementChild.dataset.time) <= time + 1e-6) now = item; }
    if (now) now.classList.add("now");
  }
  function stop() { clearInterval(timer); timer = null; play.textContent = "▶"; }
  function start() {
    let time = Number(slider.value) >= length - 0.05 ? 0 : Number(slider.value);
    let last = performance.now();
    play.textContent = "❚❚";
    timer = setInterval(() => {
      const now = performance.now();
      time += (now - last) / 1000; last = now;
      if (time >= length) { show(length); stop(); } else show(time);
    }, 50);
  }
  play.addEventListener("click", () => timer ? stop() : start());
  slider.addEventListener("input", () => { stop(); show(Number(slider.value)); });
  for (const button of host.querySelectorAll("button[data-time]")) button.addEventListener("click", () => { stop(); show(Number(button.dataset.time)); });
  show(0);
})();
