// The view in which the core works, clock by clock.
import {isCanonical} from './core_check.js';
import * as engine from './core_engine.js';
import {drawCore} from './core_picture.js';
import {drawTime, TimeLine} from './core_time.js';
import {COLORS} from './core_colors.js';
import {make, SETS} from './sets.js';
import {choices, fit, loop} from './stage.js';

const COUNTS = [50, 200, 500, 1000, 4000];
const CONTEXTS = [1, 2, 4, 8, 16, 24];
const REST = engine.ACTIVITIES.indexOf('rest');
/** Most clocks of one frame of the screen, whatever the speed, so that the page stays alive. */
const MOST_CLOCKS = 20_000;

const find = (name) => document.getElementById(`core-${name}`);

/** Opens the view. */
export function openCore() {
    const [canvas, timeCanvas, list, speed] = ['mesh', 'time', 'list', 'speed'].map(find);
    const [setChoice, countChoice, contextChoice, play] = ['set', 'count', 'contexts', 'play'].map(find);
    choices(setChoice, SETS, 'random');
    choices(countChoice, COUNTS, 500);
    choices(contextChoice, CONTEXTS, 16);
    let seed = 1;
    let [coords, contexts, state, line] = [null, 16, null, null];
    let [plays, isNew, owed, last] = [false, true, 0, 0];

    function restart() {
        contexts = Number(contextChoice.value);
        coords = make(setChoice.value, Number(countChoice.value), seed);
        engine.start(coords, contexts);
        line = new TimeLine(contexts);
        list.replaceChildren(...Array.from({length: contexts}, (_, context) => {
            const item = document.createElement('li');
            item.innerHTML = '<i></i><span></span><b></b>';
            item.firstChild.style.background = COLORS[context];
            item.firstChild.textContent = context;
            return item;
        }));
        find('status').textContent = 'Press Play.';
        look();
    }

    /** Takes the state of the core. */
    function look() {
        state = engine.state();
        isNew = true;
        if (!state.isDone) return;
        setPlay(false);
        const same = isCanonical(state.records, coords);
        const rate = (state.clocks / state.finished).toFixed(1);
        const clocks = state.clocks.toLocaleString('en');
        find('status').textContent = same ?
            `Done in ${clocks} clocks, ${rate} a point. The triangles are those of the triangulator.` :
            'The triangles differ from those of the triangulator. Please report this.';
    }

    function run(clocks) {
        if (state.isDone) return;
        line.take(engine.run(clocks));
        look();
    }

    function setPlay(on) {
        plays = on && !state.isDone;
        play.textContent = plays ? 'Pause' : 'Play';
        play.setAttribute('aria-pressed', plays);
        if (plays) find('status').textContent = '';
        [owed, last] = [0, performance.now()];
    }

    /** Clocks a second. */
    const rate = () => 10 ** Number(speed.value);

    function tellSpeed() {
        find('speed-told').textContent = `${Math.round(rate()).toLocaleString('en')} clocks a second`;
    }

    function changeSpeed(by) {
        speed.value = Number(speed.value) + by;
        tellSpeed();
    }

    function step() {
        setPlay(false);
        run(1);
    }

    play.addEventListener('click', () => setPlay(!plays));
    find('step').addEventListener('click', step);
    find('restart').addEventListener('click', () => { seed++; setPlay(false); restart(); });
    speed.addEventListener('input', tellSpeed);
    for (const choice of [setChoice, countChoice, contextChoice]) {
        choice.addEventListener('change', () => { setPlay(false); restart(); });
    }
    const keys = {
        ' ': () => setPlay(!plays),
        ArrowRight: step,
        r: () => { setPlay(false); restart(); },
        '+': () => changeSpeed(0.25),
        '=': () => changeSpeed(0.25),
        '-': () => changeSpeed(-0.25),
    };
    canvas.addEventListener('keydown', (event) => {
        const act = keys[event.key];
        if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        act();
    });

    function tell() {
        find('clock').textContent = state.clocks.toLocaleString('en');
        find('finished').textContent = `${state.finished.toLocaleString('en')} of ${(coords.length / 2).toLocaleString('en')}`;
        find('locks').textContent = state.locks;
        find('visits').textContent = state.inFlight;
        find('retries').textContent = state.retries.toLocaleString('en');
        let atWork = 0;
        for (let context = 0; context < contexts; context++) {
            const {activity, isEnding, hasPriority} = engine.decode(state.contexts[2 * context]);
            const point = state.contexts[2 * context + 1];
            const [, name, vertex] = list.children[context].children;
            atWork += point !== engine.NONE;
            name.textContent = engine.ACTIVITIES[activity] + (isEnding ? (activity === REST ? ' + release' : ' + commit') : '') + (hasPriority ? ' ★' : '');
            name.className = activity === 0 ? 'quiet' : '';
            vertex.textContent = point === engine.NONE ? '' : point;
        }
        find('work').textContent = atWork;
    }

    let size = '';
    const frame = loop((time) => {
        if (plays) {
            owed = Math.min(MOST_CLOCKS, owed + rate() * (time - last) / 1000);
            last = time;
            const clocks = Math.floor(owed);
            owed -= clocks;
            if (clocks > 0) run(clocks);
        }
        const stage = fit(canvas);
        const now = `${stage.width} ${stage.height} ${stage.ratio}`;
        if (now === size && !isNew) return;
        size = now;
        isNew = false;
        drawCore(canvas, stage, {coords, state});
        drawTime(timeCanvas, line);
        tell();
    });
    tellSpeed();
    restart();
    return {show: frame.start, hide: () => { setPlay(false); frame.stop(); }};
}
