// The view in which points are dragged and the mesh follows.
import {PlaneMesh} from './mesh.js';
import {paint} from './painter.js';
import {SETS, SIDE, onGrid} from './sets.js';
import {choices, cleared, fit, loop} from './stage.js';

const COUNTS = [10, 30, 100, 300, 1000, 10_000, 100_000];
/** Pixels around a point in which the pointer takes it. */
const REACH = 24;
/** Step of the grid onto which points snap. */
const SNAP = SIDE / 32;
/** Steps of the arrow keys, without and with Shift. */
const STEP = SIDE / 256;
const LONG_STEP = SIDE / 32;
/** Milliseconds of rest after which the ties of a large set are looked for. */
const REST = 300;
const TIE = '#ffb545';
const CHOSEN = '#ffffff';
const ARROWS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};

const find = (name) => document.getElementById(`plane-${name}`);

/** Opens the view. */
export function openPlane() {
    const [meshCanvas, marks] = [find('mesh'), find('marks')];
    const [setChoice, countChoice, snap, driftButton] = ['set', 'count', 'snap', 'drift'].map(find);
    choices(setChoice, SETS, 'random');
    choices(countChoice, COUNTS, 100);
    let seed = 1;
    let mesh;
    let chosen = -1;
    let [drags, drifts, isNew, isMarked, hadMarks] = [false, false, true, true, false];
    let [changed, last, wasNew] = [0, 0, false];
    /** Frames that were drawn anew since the rate was told, and the milliseconds that they took. */
    let [frames, spent] = [0, 0];

    function renew() {
        mesh = new PlaneMesh(setChoice.value, Number(countChoice.value), seed);
        chosen = -1;
        say(mesh.duplicates ? `${mesh.duplicates} points have the place of an earlier one` : '');
        hasChanged();
    }

    function hasChanged() {
        [isNew, isMarked, changed] = [true, true, performance.now()];
    }

    function say(text) {
        find('status').textContent = text;
    }

    /** Chooses a point and tells about it. */
    function choose(point) {
        chosen = point;
        isMarked = true;
        if (point >= 0) say(`point ${point} at (${mesh.at(point).join(', ')})`);
    }

    const snapped = (at) => snap.checked ? onGrid(Math.round(at / SNAP) * SNAP) : at;

    function moveTo(x, y) {
        mesh.move(chosen, snapped(x), snapped(y));
        choose(chosen);
        hasChanged();
    }

    function setDrift(on) {
        drifts = on;
        driftButton.setAttribute('aria-pressed', on);
        if (on) say('');
    }

    function insertAt(x, y) {
        choose(mesh.insert(snapped(x), snapped(y)));
        hasChanged();
    }

    /** The place of the pointer on the grid, and how many of its units the pointer reaches. */
    function pointed(event) {
        const stage = fit(marks);
        return [...stage.toGrid(event.offsetX, event.offsetY), REACH / stage.scale];
    }

    marks.addEventListener('pointerdown', (event) => {
        const [x, y, reach] = pointed(event);
        const point = mesh.nearest(x, y);
        const [px, py] = point < 0 ? [Infinity, Infinity] : mesh.at(point);
        drags = Math.hypot(px - x, py - y) < reach;
        choose(drags ? point : -1);
        if (drags) marks.setPointerCapture(event.pointerId);
    });
    marks.addEventListener('pointermove', (event) => {
        if (!drags || chosen < 0) return;
        const [x, y] = pointed(event);
        moveTo(x, y);
    });
    for (const end of ['pointerup', 'pointercancel']) marks.addEventListener(end, () => { drags = false; });
    marks.addEventListener('dblclick', (event) => {
        const [x, y] = pointed(event);
        insertAt(x, y);
    });

    /** What each key does. */
    const keys = {
        n: () => choose(mesh.count ? (chosen + 1) % mesh.count : -1),
        p: () => choose(mesh.count ? (Math.max(chosen, 0) + mesh.count - 1) % mesh.count : -1),
        s: () => { snap.checked = !snap.checked; },
        ' ': () => setDrift(!drifts),
        Enter: () => (chosen < 0 ? insertAt(SIDE / 2, SIDE / 2) : insertAt(...mesh.at(chosen).map((at) => at + LONG_STEP / 2))),
        Escape: () => { choose(-1); say(''); },
        Delete: () => {
            if (chosen < 0) return;
            mesh.delete(chosen);
            say(`point ${chosen} is deleted`);
            chosen = -1;
            hasChanged();
        },
    };
    keys.Backspace = keys.Delete;
    marks.addEventListener('keydown', (event) => {
        const arrow = ARROWS[event.key];
        const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
        if (event.ctrlKey || event.metaKey || event.altKey || !arrow && !act) return;
        event.preventDefault();
        if (!arrow) return act();
        if (chosen < 0) return keys.n();
        const step = snap.checked ? SNAP : event.shiftKey ? LONG_STEP : STEP;
        const [x, y] = mesh.at(chosen);
        moveTo(x + arrow[0] * step, y + arrow[1] * step);
    });

    setChoice.addEventListener('change', renew);
    countChoice.addEventListener('change', renew);
    find('again').addEventListener('click', () => { seed++; renew(); });
    driftButton.addEventListener('click', () => setDrift(!drifts));

    /** Draws what lies above the mesh: ties, the circles of the ties at the chosen point, and that point. */
    function mark(stage) {
        const hasMarks = chosen >= 0 || mesh.ties?.length > 0;
        // While points drift there is mostly nothing to mark, and an empty canvas costs the browser nothing.
        if (!hasMarks && !hadMarks) return;
        hadMarks = hasMarks;
        const pen = cleared(marks, stage.ratio);
        const at = (point) => stage.toCanvas(...mesh.at(point));
        pen.strokeStyle = TIE;
        pen.lineWidth = mesh.count > 2000 ? 0.8 : 1.8;
        pen.beginPath();
        for (let k = 0; k < (mesh.ties?.length ?? 0); k += 2) {
            pen.moveTo(...at(mesh.ties[k]));
            pen.lineTo(...at(mesh.ties[k + 1]));
        }
        pen.stroke();
        if (chosen < 0) return;
        pen.lineWidth = 1;
        for (const [x, y, radius] of mesh.circlesAt(chosen)) {
            pen.beginPath();
            pen.arc(...stage.toCanvas(x, y), radius * stage.scale, 0, 2 * Math.PI);
            pen.stroke();
        }
        pen.strokeStyle = CHOSEN;
        pen.lineWidth = 2;
        pen.beginPath();
        pen.arc(...at(chosen), 9, 0, 2 * Math.PI);
        pen.stroke();
    }

    function tell() {
        find('points').textContent = mesh.count.toLocaleString('en');
        find('triangles').textContent = mesh.triangleCount.toLocaleString('en');
        find('ties').textContent = mesh.ties ? (mesh.ties.length / 2).toLocaleString('en') : '…';
        find('time').textContent = `${mesh.time.toFixed(mesh.time < 10 ? 2 : 0)} ms`;
    }

    /** Counts the frames that are drawn anew, and tells their rate twice a second; after a second of rest there is none. */
    function count(time) {
        if (wasNew) [frames, spent] = [frames + 1, spent + time - last];
        if (spent >= 500) {
            find('rate').textContent = (1000 * frames / spent).toFixed(0);
            [frames, spent] = [0, 0];
        } else if (time - changed > 1000) {
            find('rate').textContent = '–';
            [frames, spent] = [0, 0];
        }
        last = time;
    }

    let size = '';
    const frame = loop((time) => {
        count(time);
        if (drifts) {
            mesh.drift(SIDE);
            hasChanged();
        } else if (!mesh.ties && time - changed > REST) {
            mesh.settle();
            isMarked = isNew = true;
        }
        const stage = fit(meshCanvas);
        const now = `${stage.width} ${stage.height} ${stage.ratio}`;
        if (now !== size) [size, isNew, isMarked] = [now, true, true];
        if (isNew) {
            paint(meshCanvas, stage, mesh);
            tell();
        }
        if (isMarked) mark(fit(marks));
        wasNew = isNew;
        isNew = isMarked = false;
    });
    renew();
    setDrift(false);
    return {show: frame.start, hide: frame.stop};
}
