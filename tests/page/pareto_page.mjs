// The page of rigel pareto: fronts, filters, keyboard and pointer, the table.
import {inPage, pageTest} from './harness.mjs';

for (const name of ['pareto-cpu', 'pareto-gpu']) {
  pageTest('what accuracy costs: fronts, filters, keyboard, pointer and table', name, ({page}) => inPage(page, ({check, equal, all: every, press, button: buttonIn, data}) => {
    const all = (selector, node = document) => every(node, selector);
    const button = (group, label) => buttonIn(document, group, label);
    const marks = () => all('.pareto-plot svg [role="button"]');
    const argumentsOf = (mark) => mark.dataset.arguments;
    const command = () => document.querySelector('.detail code').textContent;
    const shown = () => data.objects[0].points.filter((point) => point.bands === 3 && point.storage === 'float' && point.near_form === 'exact');
    const object = data.objects[0];
    equal(document.title, `What accuracy costs: ${data.scene}`, 'title');
    equal(marks().length, shown().length, 'marks of the compared bands, floats and forms');
    check(all('.pareto-plot svg [role="button"]').every((mark) => argumentsOf(mark) && mark.getAttribute('aria-label')), 'every mark says what it is');
    equal(marks().filter((mark) => mark.tabIndex === 0).length, 1, 'one tab stop');

    // The front as the program found it.
    const front = (cost, error) => object.fronts.find((f) => f.cost === cost && f.error === error).points.map((i) => object.points[i].arguments).sort();
    const rows = () => all('#table tbody tr').map((row) => row.querySelector('code').textContent).sort();
    equal(rows().join(), front('frame_us', 'total_rms').join(), 'front of frame and total error');
    button('Error', 'Spatial RMS').click();
    button('Cost', 'Bytes').click();
    equal(rows().join(), front('bytes', 'spatial_rms').join(), 'front of bytes and spatial error');
    button('Error', 'Total RMS').click();
    equal(button('Cost', 'Shading, GPU') !== undefined, data.gpu !== null, 'GPU axis where there is a GPU');
    if (data.gpu) {
      button('Cost', 'Shading, GPU').click();
      equal(rows().join(), front('gpu_ns_per_point', 'total_rms').join(), 'front of the GPU');
    }
    button('Cost', 'Frame').click();

    // Filters.
    button('Families of rigs', 'poly').click();
    equal(marks().length, shown().filter((point) => point.family !== 'poly').length, 'family hidden');
    check(rows().every((row) => !row.includes('poly')), 'hidden family in the table');
    button('Families of rigs', 'All').click();
    equal(marks().length, shown().length, 'all families again');
    button('Bands', '2').click();
    equal(marks().length, object.points.filter((point) => point.storage === 'float' && point.near_form === 'exact').length, 'two numbers of bands');
    button('Bands', '3').click();
    button('Bands', '2').click();  // the last one stays
    equal(marks().length, object.points.filter((point) => point.bands === 2 && point.storage === 'float').length, 'the last filter stays');
    button('Bands', '3').click();
    button('Bands', '2').click();
    for (const kind of all('[aria-label="Near lights"] button')) if (!kind.textContent.includes('2')) kind.click();
    check(marks().length > 0 && marks().every((mark) => argumentsOf(mark).includes('--near 2')), 'two near lights alone');
    for (const kind of all('[aria-label="Near lights"] button')) if (!kind.textContent.includes('2')) kind.click();

    // The keyboard.
    const first = marks().find((mark) => mark.tabIndex === 0);
    first.focus();
    check(command().includes(argumentsOf(first)), `focus shows ${argumentsOf(first)}: ${command()}`);
    press(first, 'Home');
    const home = document.activeElement;
    press(home, 'ArrowRight');
    const second = document.activeElement;
    check(second !== home && marks().includes(second), 'arrow right moves on');
    check(command().includes(argumentsOf(second)), 'detail follows the keyboard');
    press(second, 'Enter');
    second.blur();
    check(command().includes(argumentsOf(second)), 'Enter keeps the point');
    check(second.classList.contains('chosen'), 'the chosen mark is marked');
    check(command().startsWith(`rigel report ${data.scene} --clip drive`), `command: ${command()}`);

    // The pointer.
    const target = marks()[3];
    const box = target.getBoundingClientRect();
    const at = {clientX: box.left + box.width / 2, clientY: box.top + box.height / 2, bubbles: true};
    document.querySelector('.pareto-plot').dispatchEvent(new PointerEvent('pointermove', at));
    const hovered = marks().find((mark) => mark.classList.contains('hovered'));
    check(hovered !== undefined && !document.querySelector('.readout').hidden, 'pointing shows a point');
    check(hovered && command().includes(argumentsOf(hovered)), 'detail follows the pointer');
    document.querySelector('.pareto-plot').dispatchEvent(new PointerEvent('pointerleave'));
    check(document.querySelector('.readout').hidden, 'and forgets it');

    // The table sorts.
    button('Rows', 'All that is shown').click();
    const sort = all('#table .sort').find((candidate) => candidate.textContent.startsWith('Total RMS'));
    sort.click();
    const errors = () => all('#table tbody tr').map((row) => parseFloat(row.cells[1].textContent));
    check(errors().every((value, i, values) => !i || values[i - 1] <= value), 'rising errors');
    sort.click();
    check(errors().every((value, i, values) => !i || values[i - 1] >= value), 'falling errors');

    // Objects: without light there is nothing to draw, and names stay text.
    const objects = all('[aria-label="Object"] button');
    equal(objects.length, data.objects.length, 'objects');
    objects[1].click();
    equal(marks().length, 0, 'nothing without light');
    objects[2].click();
    equal(marks().length, shown().length, 'and back');
    equal(document.title, `What accuracy costs: ${data.scene}`, 'no name runs');
  }));
}
