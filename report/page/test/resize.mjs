/** Gives the window a size, and the page the frames that it needs to lay itself out and draw again:
 * elements that a test has found before may be others afterwards. */
export async function resize(page, size) {
  await page.setViewportSize(size);
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );
}
