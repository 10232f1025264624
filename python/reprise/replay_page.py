"""The page of a trace with its slider: {svg} and {data} are put in by view.py."""

REPLAY = """<style>
body { font-family: sans-serif; color: #2b2f33 }
.bar { display: flex; gap: 10px; align-items: center; padding: 8px }
.bar input[type=range] { flex: 1 }
.bar button { width: 5.5em; padding: 4px }
.bar output { min-width: 17em; font-variant-numeric: tabular-nums }
svg { display: block; max-height: calc(100vh - 50px) !important }
</style>
{svg}
<div class="bar">
<button type="button">play</button>
<input type="range" min="0" value="0" step="1" aria-label="tick">
<output></output>
<label>speed <select><option>0.25<option>0.5<option selected>1<option>2<option>5<option>10</select></label>
<label><input type="checkbox" checked> follow</label>
</div>
<script type="application/json" id="data">{data}</script>
<script>
"use strict";
const { frames, colours, radius, seconds } = JSON.parse(document.getElementById("data").textContent);
const svg = document.querySelector("svg"), whole = svg.getAttribute("viewBox");
const actors = [...svg.querySelector(".actors").children], signals = [...svg.querySelector(".signals").children];
const corner = svg.querySelector(".corner"), slider = document.querySelector("input[type=range]");
const play = document.querySelector("button"), says = document.querySelector("output");
const speed = document.querySelector("select"), follow = document.querySelector("input[type=checkbox]");
let shown = -1, playing = false, since = 0, from = 0;
slider.max = frames.length - 1;

// Signals are said where they change: those of a frame are the last ones said before it.
function signalsAt(frame) {
    while (frame > 0 && frames[frame].signals === null) frame--;
    return frames[frame].signals || "";
}

function show(frame) {
    const { actors: there, at, says: text } = frames[frame];
    const hidden = new Set(actors.keys());
    for (let i = 0; i < there.length; i += 4) {
        const [slot, x, y, turned] = there.slice(i, i + 4);
        actors[slot].setAttribute("transform", `translate(${x} ${y}) rotate(${turned})`);
        actors[slot].setAttribute("visibility", "visible");
        hidden.delete(slot);
    }
    for (const slot of hidden) actors[slot].setAttribute("visibility", "hidden");
    const now = signalsAt(frame);
    if (shown < 0 || now !== signalsAt(shown))
        signals.forEach((bar, i) => bar.setAttribute("fill", colours[now[i]]));
    const near = follow.checked && at;
    svg.setAttribute("viewBox", near ? `${at[0] - 1.6 * radius} ${at[1] - radius} ${3.2 * radius} ${2 * radius}` : whole);
    corner.setAttribute("visibility", near ? "hidden" : "visible");
    for (const title of svg.querySelectorAll(".title")) title.textContent = text;
    says.textContent = text;
    slider.value = frame;
    shown = frame;
}

function advance(now) {
    if (!playing) return;
    const frame = from + Math.floor((now - since) / 1000 / seconds * speed.value);
    show(Math.min(frame, frames.length - 1));
    if (frame >= frames.length - 1) pause(); else requestAnimationFrame(advance);
}

function begin() {
    playing = true;
    play.textContent = "pause";
    from = shown >= frames.length - 1 ? 0 : shown;
    since = performance.now();
    requestAnimationFrame(advance);
}

function pause() {
    playing = false;
    play.textContent = "play";
}

play.onclick = () => playing ? pause() : begin();
slider.oninput = () => { pause(); show(+slider.value); };
speed.onchange = () => { if (playing) begin(); };
follow.onchange = () => show(shown);
follow.parentElement.hidden = !frames.some(frame => frame.at);
show(0);
</script>
"""
