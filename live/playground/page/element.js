// Defines <visual-scheme src="model.vs"> for other pages: the model in a frame, with its sliders. The program runs in the
// frame's worker, when the frame is first seen. Attributes: src, an address of a program; source, to show its text, too;
// width and height as those of an iframe. Without src the program is the element's text.
{
  const base = new URL(".", document.currentScript.src).href;
  const pack = async (program) => {
    const bytes = new Uint8Array(await new Response(new Blob([JSON.stringify(program)]).stream().pipeThrough(new CompressionStream("deflate-raw"))).arrayBuffer());
    return btoa(bytes.reduce((all, byte) => all + String.fromCharCode(byte), "")).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
  };
  customElements.define("visual-scheme", class extends HTMLElement {
    connectedCallback() {
      this.seen = new IntersectionObserver((entries) => { if (entries.some((e) => e.isIntersecting)) this.seen.disconnect(), this.#open(); });
      this.seen.observe(this);
      if (getComputedStyle(this).display === "inline") this.style.display = "block";
    }
    disconnectedCallback() { this.seen?.disconnect(); }
    async #open() {
      const src = this.getAttribute("src"), answer = src && await fetch(src).catch(() => null);
      if (src && !answer?.ok) {
        this.textContent = `The program ${src} cannot be read.`;
        return;
      }
      const text = src ? await answer.text() : this.textContent, name = src ? new URL(src, location.href).pathname.split("/").pop() || "model.vs" : "model.vs";
      const frame = document.createElement("iframe");
      frame.title = name;
      frame.style.cssText = `border:0;width:${Number(this.getAttribute("width")) ? this.getAttribute("width") + "px" : "100%"};height:${Number(this.getAttribute("height")) || 480}px`;
      frame.onload = () => frame.contentWindow.postMessage("run", "*");
      frame.src = base + "index.html#" + (this.hasAttribute("source") ? "pane=1&" : "") + "program=" + await pack({ name, text, values: [] });
      this.replaceChildren(frame);
    }
  });
}
