// SPDX-License-Identifier: Apache-2.0
// Shows the scan and the surfaces of the page in the viewer. Where there is no WebGL the section stays
// hidden, and the pictures tell the same.
"use strict";
// On paper everything is open.
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(d => { d.open = true; }));
(async () => {
  const by = id => document.getElementById(id);
  const bytes = id => {
    const text = atob(by(id).textContent);
    const out = new Uint8Array(text.length);
    for (let n = 0; n < text.length; ++n) out[n] = text.charCodeAt(n);
    return out.buffer;
  };
  const section = by("viewer"), canvas = by("gl");
  if (!section || !document.createElement("canvas").getContext("webgl2")) return;
  section.hidden = false;
  const facts = JSON.parse(by("viewer-facts").textContent);
  const {Niivue, NVMesh, NVImage, SLICE_TYPE} = niivue;
  const nv = new Niivue({
    backColor: [0.059, 0.071, 0.086, 1], show3Dcrosshair: false, crosshairColor: [0.39, 0.78, 0.73, 0.7],
    crosshairWidth: 0.3, crosshairWidthUnit: "percent", multiplanarLayout: 2, multiplanarPadPixels: 6,
    multiplanarEqualSize: false, isOrientCube: false, dragAndDropEnabled: false, multiplanarForceRender: true,
    isRadiologicalConvention: true, sagittalNoseLeft: true, meshThicknessOn2D: facts.voxel, clipPlaneColor: [0, 0, 0, 0], loadingText: "",
    isResizeCanvas: true, logLevel: "error", isColorbar: false, fontSizeScaling: 0.6
  });
  await nv.attachToCanvas(canvas);
  nv.addVolume(await NVImage.new(bytes("scan-copy"), "scan.nii.gz"));
  const surfaces = [];
  for (let n = 0; n < facts.surfaces.length; ++n) {
    const rgb = facts.surfaces[n].rgb;
    const mesh = await NVMesh.readMesh(bytes("surface-" + n), "surface.mz3", nv.gl, 1, new Uint8Array([...rgb, 255]));
    nv.addMesh(mesh);
    surfaces.push(mesh);
  }
  const layouts = {multi: SLICE_TYPE.MULTIPLANAR, axial: SLICE_TYPE.AXIAL, coronal: SLICE_TYPE.CORONAL,
                   sagittal: SLICE_TYPE.SAGITTAL, render: SLICE_TYPE.RENDER};
  const buttons = [...section.querySelectorAll("button[data-layout]")];
  const show = name => {
    nv.setSliceType(layouts[name]);
    for (const b of buttons) b.setAttribute("aria-pressed", String(b.dataset.layout === name));
  };
  for (const b of buttons) b.addEventListener("click", () => show(b.dataset.layout));

  const volume = nv.volumes[0];
  const range = (id, low, high, step, value, apply) => {
    const input = by(id);
    Object.assign(input, {min: low, max: high, step});
    input.value = value;
    input.addEventListener("input", () => { apply(Number(input.value)); nv.drawScene(); });
    return input;
  };
  const axes = ["x", "y", "z"].map((axis, n) =>
    range("at-" + axis, 0, 1, 0.002, 0.5, v => { nv.scene.crosshairPos[n] = v; }));
  nv.onLocationChange = () => axes.forEach((input, n) => { input.value = nv.scene.crosshairPos[n]; });
  const [low, high] = facts.range, step = (high - low) / 500;
  const window_ = () => {
    volume.cal_min = Number(by("window-low").value);
    volume.cal_max = Math.max(Number(by("window-high").value), volume.cal_min + step);
    nv.updateGLVolume();
  };
  range("window-low", low, high, step, facts.window[0], window_);
  range("window-high", low, high, step, facts.window[1], window_);
  const opaque = surface => by("show-" + surface).checked ? Number(by("opacity").value) : 0;
  const fade = () => surfaces.forEach((mesh, n) => {
    mesh.opacity = opaque(n);
    mesh.visible = mesh.opacity > 0;
  });
  range("opacity", 0, 1, 0.02, 1, fade);
  for (const box of section.querySelectorAll("input[data-surface]")) {
    box.addEventListener("change", () => { fade(); nv.drawScene(); });
  }
  window_();
  // In space the surface alone: the scan would hide it, and is cut away.
  if (surfaces.length) nv.setClipPlane([-1.8, 0, 0]);
  show("multi");
  nv.setRenderAzimuthElevation(145, 20);
  nv.drawScene();
  section.dataset.ready = "yes";
})().catch(error => {
  const section = document.getElementById("viewer");
  if (section) section.hidden = true;
  console.error("viewer: " + error);
});
