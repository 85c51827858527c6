// The two views of the page, and the tabs that choose one.
import {openCore} from './core.js';
import {openPlane} from './plane.js';

const views = [openPlane(), openCore()];
const tabs = [...document.querySelectorAll('[role=tab]')];

/** Shows the view of a tab. Only the view that is shown works. */
function show(chosen) {
    for (const [number, tab] of tabs.entries()) {
        const isChosen = number === chosen;
        tab.setAttribute('aria-selected', isChosen);
        tab.tabIndex = isChosen ? 0 : -1;
        document.getElementById(tab.getAttribute('aria-controls')).hidden = !isChosen;
        if (isChosen) views[number].show();
        else views[number].hide();
    }
}

for (const [number, tab] of tabs.entries()) {
    tab.addEventListener('click', () => show(number));
    tab.addEventListener('keydown', (event) => {
        if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
        const other = (number + 1) % tabs.length;
        show(other);
        tabs[other].focus();
    });
}
show(location.hash === '#core' ? 1 : 0);
