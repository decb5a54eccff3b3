// A small picture of an object, beside its name.

const kPortrait = {width: 128, height: 96};

/** A canvas that is drawn once it is near the window; null for an object without pictures. */
function portrait(objectIndex) {
  const frames = pictureFrames(objectIndex);
  if (!frames.length || !canUnpack) return null;
  // The smallest is quick to unpack and large enough.
  const frame = frames.reduce((least, candidate) => (candidate.width < least.width ? candidate : least));
  const canvas = element('canvas', {class: 'portrait', ...kPortrait, 'aria-hidden': 'true'});
  whenNear(canvas, async () => {
    const numbers = await frameNumbers(frame);
    const source = drawnOnce(['portrait', objectIndex].join(), () => shadedPicture(numbers, numbers.truth, frame.exposure));
    // The middle of the picture, in the portrait's proportions.
    const height = Math.min(source.height, source.width * kPortrait.height / kPortrait.width);
    const width = height * kPortrait.width / kPortrait.height;
    const pen = canvas.getContext('2d');
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(source, (source.width - width) / 2, (source.height - height) / 2, width, height, 0, 0, kPortrait.width, kPortrait.height);
  });
  return canvas;
}

/** Calls `draw` once, as soon as `node` is within a window's distance of being seen. */
function whenNear(node, draw) {
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    draw();
  }, {rootMargin: '400px'});
  observer.observe(node);
}
