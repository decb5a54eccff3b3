// Pictures of a report: the wipe, frames, thumbnails.
import {inPage, pageTest, reports} from './harness.mjs';

for (const name of reports) {
  pageTest('the pictures of a report: wipe, frames, thumbnails', name, ({page}) => inPage(page, ({check, equal, all, press, pointer, button, data}) => {
    const pictureData = JSON.parse(document.getElementById('picture-data').textContent);
    const checkObject = (section, object) => {
      const pictures = object.pictures.filter((picture) => picture.frame === object.pictures[0].frame);
      const frames = new Set(object.pictures.map((picture) => picture.frame));
      const stage = section.querySelector('.wipe .stage');
      const range = section.querySelector('.wipe input');
      const wipe = () => parseFloat(stage.style.getPropertyValue('--wipe'));

      range.value = 20;
      range.dispatchEvent(new Event('input'));
      equal(wipe(), 20, 'slider');
      press(range, 'ArrowRight');
      equal(wipe(), 22, 'arrow right');
      for (let i = 0; i < 20; ++i) press(range, 'ArrowLeft');
      equal(wipe(), 0, 'arrow left stops at the edge');
      const box = stage.getBoundingClientRect();
      pointer(stage, 'pointerdown', box.left + 0.25 * box.width);
      check(Math.abs(wipe() - 25) < 0.01, `press on the picture: ${wipe()}`);
      pointer(document, 'pointermove', box.right + 50);
      equal(wipe(), 100, 'drag beyond the picture');
      pointer(document, 'pointerup', box.right + 50);
      pointer(document, 'pointermove', box.left);
      equal(wipe(), 100, 'no drag after the release');

      equal(all(section, '.thumbnail').length, pictures.length, 'thumbnails');
      check(all(section, 'img').every((image) => image.src.startsWith('data:image/png;base64,')), 'a picture is not embedded');
      const rig = pictures[1];
      all(section, 'button.thumbnail')[0].click();
      equal(section.querySelector('.tag.left').textContent, rig.label, 'thumbnail chooses its rig');
      equal(button(section, 'Rig', rig.label).getAttribute('aria-pressed'), 'true', 'rig button follows');
      equal(section.querySelector('tr.chosen .pick')?.textContent, rig.label, 'table follows');
      equal(all(section, '[aria-label="Frame"] button').length, frames.size > 1 ? frames.size : 0, 'frame buttons');
      if (frames.size > 1) {
        all(section, '[aria-label="Frame"] button')[1].click();
        const second = object.pictures.findIndex((picture) => picture.frame !== object.pictures[0].frame);
        equal(all(section, '.stage img')[0].src, pictureData.objects[data.objects.indexOf(object)][second].image, 'truth of the second frame');
      }
      button(section, 'Show', 'Differences').click();
      equal(all(section, 'button.thumbnail img')[0].src, section.querySelector('.heat img').src, 'differences as thumbnails');
    };

    const sections = all(document, 'section.object');
    equal(sections.length, data.objects.length, 'sections');
    data.objects.forEach((object, i) => {
      if (object.pictures.length) checkObject(sections[i], object);
    });
  }));
}
