/* A slider between two pictures, and a small viewer of coloured points and triangles. */
(function () {
  const cut = document.getElementById("cut"), pair = document.getElementById("slider");
  if (cut) {
    const set = value => { cut.value = value; pair.style.setProperty("--cut", value + "%"); };
    cut.addEventListener("input", () => set(cut.value));
    const drag = event => { const box = pair.getBoundingClientRect(); set(Math.max(0, Math.min(100, 100 * (event.clientX - box.left) / box.width))); };
    pair.addEventListener("pointerdown", event => { pair.setPointerCapture(event.pointerId); drag(event); event.preventDefault(); });
    pair.addEventListener("pointermove", event => { if (event.buttons) drag(event); });
    set(50);
  }
  const canvas = document.getElementById("view3d");
  if (!canvas || !data.view) return;
  const gl = canvas.getContext("webgl");
  if (!gl) { canvas.replaceWith(Object.assign(document.createElement("p"), { className: "notice", textContent: "This browser has no WebGL, so there is no three-dimensional view." })); return; }
  const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const shader = (kind, source) => { const s = gl.createShader(kind); gl.shaderSource(s, source); gl.compileShader(s); return s; };
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, "attribute vec3 p;attribute vec3 c;attribute vec3 n;uniform mat4 m;uniform float lit,size;varying vec3 col;void main(){gl_Position=m*vec4(p,1.);gl_PointSize=size;float d=mix(1.,.45+.55*abs(dot(normalize(n+vec3(1e-6)),normalize(vec3(.4,-.5,.8)))),lit);col=c*d;}"));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, "precision mediump float;varying vec3 col;uniform float alpha;void main(){gl_FragColor=vec4(col,alpha);}"));
  gl.linkProgram(program); gl.useProgram(program);
  const place = name => gl.getAttribLocation(program, name), uniform = name => gl.getUniformLocation(program, name);
  const buffer = values => { const b = gl.createBuffer(); gl.bindBuffer(gl.ARRAY_BUFFER, b); gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW); return b; };
  const upload = ({ xyz, rgb }, triangles) => {
    const raw = new Int16Array(bytes(xyz).buffer), colors = bytes(rgb), count = raw.length / 3;
    const p = Float32Array.from(raw, v => v / 2000), c = Float32Array.from(colors, v => v / 255), n = new Float32Array(raw.length);
    if (triangles) for (let i = 0; i < raw.length; i += 9) {
      const u = [p[i + 3] - p[i], p[i + 4] - p[i + 1], p[i + 5] - p[i + 2]], v = [p[i + 6] - p[i], p[i + 7] - p[i + 1], p[i + 8] - p[i + 2]];
      const x = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], l = Math.hypot(...x) || 1;
      for (let k = 0; k < 9; k++) n[i + k] = x[k % 3] / l;
    }
    return { count, p: buffer(p), c: buffer(c), n: buffer(n) };
  };
  const points = upload(data.view.points, false), bodies = upload(data.view.bodies, true);
  // A narrow window sees less to the sides: as far away as shows the same.
  let azimuth = 0.6, elevation = 0.6, distance = 1.2 * Math.max(1, 1.3 * canvas.clientHeight / canvas.clientWidth);
  const target = data.view.target;
  const multiply = (a, b) => { const o = new Float32Array(16); for (let i = 0; i < 4; i++) for (let j = 0; j < 4; j++) for (let k = 0; k < 4; k++) o[4 * j + i] += a[4 * k + i] * b[4 * j + k]; return o; };
  function draw() {
    const ratio = Math.min(devicePixelRatio || 1, 2), w = canvas.clientWidth * ratio | 0, h = canvas.clientHeight * ratio | 0;
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    const ce = Math.cos(elevation), eye = [target[0] + distance * ce * Math.cos(azimuth), target[1] + distance * ce * Math.sin(azimuth), target[2] + distance * Math.sin(elevation)];
    const f = target.map((t, i) => (t - eye[i]) / distance), r = [f[1], -f[0], 0].map(v => v / Math.hypot(f[0], f[1])), u = [r[1] * f[2] - r[2] * f[1], r[2] * f[0] - r[0] * f[2], r[0] * f[1] - r[1] * f[0]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const view = new Float32Array([r[0], u[0], -f[0], 0, r[1], u[1], -f[1], 0, r[2], u[2], -f[2], 0, -dot(r, eye), -dot(u, eye), dot(f, eye), 1]);
    const s = 1 / Math.tan(0.35), near = 0.02, far = 20;
    const lens = new Float32Array([s * h / w, 0, 0, 0, 0, s, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
    gl.viewport(0, 0, w, h); gl.clearColor(0.93, 0.94, 0.95, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT); gl.enable(gl.DEPTH_TEST);
    gl.uniformMatrix4fv(uniform("m"), false, multiply(lens, view));
    const part = (mesh, mode, lit) => {
      for (const name of ["p", "c", "n"]) { gl.bindBuffer(gl.ARRAY_BUFFER, mesh[name]); gl.enableVertexAttribArray(place(name)); gl.vertexAttribPointer(place(name), 3, gl.FLOAT, false, 0, 0); }
      gl.uniform1f(uniform("lit"), lit); gl.uniform1f(uniform("size"), 2.2 * ratio); gl.uniform1f(uniform("alpha"), 1);
      gl.drawArrays(mode, 0, mesh.count);
    };
    if (document.getElementById("show-bodies").checked) part(bodies, gl.TRIANGLES, 1);
    if (document.getElementById("show-points").checked) part(points, gl.POINTS, 0);
    canvas.dataset.drawn = String(Number(canvas.dataset.drawn || 0) + 1);
  }
  const turn = (x, y) => { azimuth -= x; elevation = Math.max(-1.4, Math.min(1.5, elevation + y)); draw(); };
  const zoomBy = factor => { distance = Math.max(0.15, Math.min(6, distance * factor)); draw(); };
  let last = null, pinch = null; const held = new Map();
  canvas.addEventListener("pointerdown", e => { canvas.setPointerCapture(e.pointerId); held.set(e.pointerId, e); last = e; });
  canvas.addEventListener("pointerup", e => { held.delete(e.pointerId); pinch = null; last = [...held.values()][0] || null; });
  canvas.addEventListener("pointermove", e => {
    if (!held.has(e.pointerId)) return;
    held.set(e.pointerId, e);
    if (held.size === 2) { const [a, b] = [...held.values()], d = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY); if (pinch) zoomBy(pinch / d); pinch = d; return; }
    turn((e.clientX - last.clientX) / 150, (e.clientY - last.clientY) / 150); last = e;
  });
  canvas.addEventListener("wheel", e => { e.preventDefault(); zoomBy(Math.exp(e.deltaY / 600)); }, { passive: false });
  canvas.addEventListener("keydown", e => {
    const done = { ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1), "+": () => zoomBy(0.9), "-": () => zoomBy(1.1) }[e.key];
    if (done) { e.preventDefault(); done(); }
  });
  for (const id of ["show-points", "show-bodies"]) document.getElementById(id).addEventListener("change", draw);
  addEventListener("resize", draw);
  draw();
})();
