// Figures are looked at closely: drag with the mouse to enlarge what lies in the frame, the button shows all again.
for (const svg of document.querySelectorAll("figure svg[viewBox]")) {
  const whole = svg.getAttribute("viewBox");
  svg.style.aspectRatio = whole.split(/[\s,]+/).slice(2).join("/");
  const back = document.createElement("button");
  back.textContent = "whole figure";
  back.hidden = true;
  back.onclick = () => { svg.setAttribute("viewBox", whole); back.hidden = true; };
  svg.closest("figure").append(back);
  const at = event => new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  let from = null, frame = null;
  svg.addEventListener("pointerdown", event => {
    if (event.pointerType !== "mouse" || event.button !== 0) return;
    event.preventDefault();
    svg.setPointerCapture(event.pointerId);
    from = at(event);
    frame = svg.appendChild(document.createElementNS(svg.namespaceURI, "rect"));
    frame.setAttribute("style", "fill:#0b539422;stroke:#0b5394;vector-effect:non-scaling-stroke");
  });
  const drawn = event => {
    const to = at(event);
    return [Math.min(from.x, to.x), Math.min(from.y, to.y), Math.abs(to.x - from.x), Math.abs(to.y - from.y)];
  };
  svg.addEventListener("pointermove", event => {
    if (frame) drawn(event).forEach((v, k) => frame.setAttribute(["x", "y", "width", "height"][k], v));
  });
  svg.addEventListener("pointerup", event => {
    if (!frame) return;
    const box = drawn(event), all = svg.viewBox.baseVal;
    frame.remove();
    from = frame = null;
    if (box[2] < all.width / 100 || box[3] < all.height / 100) return; // a click
    svg.setAttribute("viewBox", box.join(" "));
    back.hidden = false;
  });
}
// On paper nothing can be opened: what is folded away is printed whole.
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(part => (part.open = true)));
