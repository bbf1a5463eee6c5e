"use strict";
const stored = id => JSON.parse(document.getElementById(id).textContent);
const pictures = stored("pictures"), data = stored("data");
function make(tag, attributes, ...content) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name === "class") element.className = value;
    else if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value);
  }
  for (const item of content) if (item !== null && item !== undefined) element.append(item);
  return element;
}
function showPicture(image, key) {
  if (key in pictures) image.src = pictures[key];
  else image.remove();
}
for (const image of document.querySelectorAll("img[data-picture]")) showPicture(image, image.dataset.picture);
function zoom(key, caption) {
  const dialog = document.getElementById("zoom");
  dialog.querySelector("img").src = pictures[key];
  dialog.querySelector("img").alt = caption;
  dialog.querySelector("p").textContent = caption;
  dialog.showModal();
}
for (const button of document.querySelectorAll("button[data-zoom]"))
  button.addEventListener("click", () => zoom(button.dataset.zoom, button.dataset.caption || ""));
document.getElementById("zoom").addEventListener("click", event => {
  if (event.target === event.currentTarget) event.currentTarget.close();
});
document.getElementById("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});
