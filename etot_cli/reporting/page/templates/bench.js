const KEYS = ["method", "task", "number", "status", "cls", "reason", "replans", "actions", "harm", "wall", "link", "seed"];
const trials = data.trials.map(row => Object.fromEntries(KEYS.map((key, index) => [key, row[index]])));
function show(method, task) {
  const table = document.getElementById("trials"), body = table.tBodies[0];
  const own = trials.filter(trial => trial.method === method && (task === "" || trial.task === task));
  body.replaceChildren(...own.map(trial => {
    const status = trial.status === "error" ? "unsafe" : trial.status;
    const chip = make("span", {class: "chip " + status}, data.symbols[status] + " " + trial.status);
    const words = make("td", {class: "long"}, trial.actions.join(" "));
    const why = [trial.reason, ...trial.harm].filter(Boolean).join("; ");
    if (why) words.append(make("br"), make("small", {}, (trial.cls ? trial.cls.replace("_", " ") + ": " : "") + why));
    const link = trial.link ? make("a", {href: trial.link, "aria-label": `trial ${trial.number + 1} of ${trial.task}`}, "open") : "–";
    return make("tr", {}, make("td", {}, trial.task), make("td", {class: "num"}, String(trial.number + 1)),
      make("td", {}, chip), words, make("td", {class: "num", "data-unit": "replans"}, String(trial.replans)),
      make("td", {class: "num", "data-unit": "s"}, trial.wall.toFixed(1)), make("td", {}, link));
  }));
  table.hidden = own.length === 0;
  document.getElementById("chosen").textContent = `${data.titles[method]}${task ? " on " + task : ""}: ${own.length} trial${own.length === 1 ? "" : "s"}`;
}
for (const cell of document.querySelectorAll("button.cell"))
  cell.addEventListener("click", () => {
    for (const other of document.querySelectorAll("button.cell[aria-pressed=true]")) other.setAttribute("aria-pressed", "false");
    cell.setAttribute("aria-pressed", "true");
    show(cell.dataset.method, cell.dataset.task);
    document.getElementById("trials-h").scrollIntoView({block: "nearest"});
  });
