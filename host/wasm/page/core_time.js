// The work of each context at the last clocks, a row for each.
import {decode} from './core_engine.js';
import {COLORS} from './core_colors.js';
import {cleared, fit} from './stage.js';

/** Clocks that fit into the picture. */
const CLOCKS = 320;
/** Room for the numbers of the contexts, in pixels. */
const LEFT = 34;
/** How much of the colour of its context each activity has, and how much of its row it fills. */
const LOOKS = [[0, 0], [0.28, 0.3], [0.6, 0.5], [1, 0.85], [0.45, 0.85], [0, 0], [1, 1]];

/** The last clocks of a job. */
export class TimeLine {
    constructor(contexts) {
        this.contexts = contexts;
        /** The activities of all contexts, clock after clock. */
        this.listed = [];
    }

    /** Takes the activities of more clocks. */
    take(listed) {
        const most = CLOCKS * this.contexts;
        this.listed.push(...listed.subarray(Math.max(0, listed.length - most)));
        if (this.listed.length > most) this.listed.splice(0, this.listed.length - most);
    }
}

/** Draws the time line: walks low, cavities high, aborting attempts pale, commits as a line below. */
export function drawTime(canvas, line) {
    const {ratio, width, height} = fit(canvas);
    const pen = cleared(canvas, ratio);
    const row = (height - 14) / line.contexts;
    const wide = (width - LEFT - 12) / CLOCKS;
    pen.font = `${Math.min(11, row)}px system-ui, sans-serif`;
    pen.textBaseline = 'middle';
    pen.textAlign = 'right';
    for (let context = 0; context < line.contexts; context++) {
        const bottom = 7 + (context + 1) * row;
        pen.globalAlpha = 1;
        pen.fillStyle = COLORS[context];
        pen.fillText(context, LEFT - 9, bottom - row / 2);
        for (let clock = 0; clock * line.contexts < line.listed.length; clock++) {
            const {activity, isEnding} = decode(line.listed[clock * line.contexts + context]);
            const [strength, share] = LOOKS[activity];
            const [left, high] = [LEFT + clock * wide, share * (row - 3)];
            pen.globalAlpha = strength;
            pen.fillRect(left, bottom - 2 - high, wide + 0.3, high);
            if (!isEnding) continue;
            pen.globalAlpha = 0.9;
            pen.fillRect(left, bottom - 1.5, wide + 0.3, 1.5);
        }
    }
    pen.globalAlpha = 1;
}
