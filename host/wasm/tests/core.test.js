// The model of the core that the page shows.
import assert from 'node:assert/strict';
import test from 'node:test';
import {isCanonical} from '../page/core_check.js';
import {ACTIVITIES, NONE, decode, run, start, state} from '../page/core_engine.js';
import {SETS, make} from '../page/sets.js';

for (const set of SETS) {
    test(`the core gives the canonical mesh of the set ${set}, with any number of contexts`, () => {
        for (const [count, contexts] of [[3, 16], [60, 1], [500, 16], [700, 24]]) {
            const coords = make(set, count, 3);
            start(coords, contexts);
            run(400 * count + 1000);
            const {isDone, finished, locks, inFlight, records} = state();
            assert.ok(isDone, `${finished} of ${count} points are in the mesh`);
            assert.deepEqual([finished, locks, inFlight], [count, 0, 0]);
            assert.ok(isCanonical(records, coords), `${count} points, ${contexts} contexts`);
            if (count === 3) continue;
            assert.ok(!isCanonical(records, make(set === 'grid' ? 'random' : 'grid', count, 4)), 'another mesh is told apart');
        }
    });
}

test('each clock tells the activity of every context, and locks belong to contexts at work', () => {
    const coords = make('random', 400, 5);
    start(coords, 16);
    const seen = new Set();
    let [clocks, most] = [0, 0];
    while (!state().isDone) {
        const listed = run(1);
        assert.equal(listed.length, 16);
        assert.equal(state().clocks, ++clocks);
        const {contexts, records, locks} = state();
        listed.forEach((one, context) => {
            assert.equal(one, contexts[2 * context]);
            seen.add(ACTIVITIES[decode(one).activity]);
        });
        let held = 0;
        for (let k = 0; k < records.length; k += 5) {
            if (records[k + 3] === NONE) continue;
            held++;
            const {activity, isEnding} = decode(contexts[2 * records[k + 3]]);
            assert.ok(isEnding || !['idle', 'walk', 'rest'].includes(ACTIVITIES[activity]), `clock ${clocks}`);
            if (records[k + 4] === 1) assert.ok(['root', 'cavity', 'drain'].includes(ACTIVITIES[activity]));
        }
        // The records of a star that is being written have locks before they count.
        assert.ok(held <= locks);
        most = Math.max(most, new Set([...contexts].filter((point, k) => k % 2 && point !== NONE)).size);
    }
    assert.equal(most, 16, 'points in flight');
    assert.deepEqual([...seen].sort(), ['cavity', 'drain', 'idle', 'rest', 'root', 'walk']);
    assert.equal(run(100).length, 0, 'a job that is done takes no more clocks');
    assert.equal(state().clocks, clocks);
});

test('sets that the core cannot take are refused with a sentence', () => {
    for (const [coords, contexts, reason] of [
        [[0, 0, 1, 1, 2, 2], 16, /one line/],
        [[], 16, /one line/],
        [[0, 0, 1, 0, 0.5, 1], 16, /whole coordinates.*0\.5/],
        [[0, 0, 1, 0, 0, 65536], 16, /65536/],
        [[0, 0, 1, 0, NaN, 1], 16, /NaN/],
        [make('random', 8193, 1), 16, /8192 points, and here are 8193/],
        [make('random', 9, 1), 0, /contexts/],
        [make('random', 9, 1), 25, /25 contexts/],
    ]) assert.throws(() => start(coords, contexts), reason);
});
