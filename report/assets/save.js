// Saves figures as SVG and their data as CSV, without asking anybody.
(() => {
  const save = (name, type, text) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], { type }));
    link.download = name;
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  };
  rigproof.saveCsv = (name, rows) => {
    const field = (value) => {
      const text = value === null || value === undefined ? '' : String(value);
      return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    };
    save(`${name}.csv`, 'text/csv', rows.map((row) => row.map(field).join(',')).join('\n') + '\n');
  };
  rigproof.saveSvg = (name, text) => save(`${name}.svg`, 'image/svg+xml', `<?xml version="1.0" encoding="UTF-8"?>\n${text}\n`);

  // A drawing of the page, on its own: colours that the style sheet gives it are written into it.
  rigproof.standalone = (drawing) => {
    const copy = drawing.cloneNode(true);
    const kept = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'font-size', 'font-family', 'font-weight', 'opacity'];
    const originals = [drawing, ...drawing.querySelectorAll('*')];
    [copy, ...copy.querySelectorAll('*')].forEach((element, k) => {
      const style = getComputedStyle(originals[k]);
      for (const property of kept) element.setAttribute(property, style.getPropertyValue(property));
      element.removeAttribute('class');
    });
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    const box = drawing.viewBox.baseVal;
    copy.setAttribute('width', box.width);
    copy.setAttribute('height', box.height);
    const back = document.createElementNS('http://www.w3.org/2000/svg', 'rect');
    const whole = { x: box.x, y: box.y, width: box.width, height: box.height, fill: rigproof.colour('card') };
    for (const [key, value] of Object.entries(whole)) back.setAttribute(key, value);
    copy.prepend(back);
    return new XMLSerializer().serializeToString(copy);
  };

  // What a picture holds, which stands in the page once.
  const bytes = (source) => Uint8Array.from(atob(source.slice(source.indexOf(',') + 1)), (letter) => letter.charCodeAt(0));

  // Asked of the page and not of each button: a list that is renewed brings buttons of its own.
  document.addEventListener('click', (event) => {
    const { saveDrawing, savePicture, saveTable } = event.target.closest('button')?.dataset ?? {};
    if (saveDrawing) rigproof.saveSvg(saveDrawing, rigproof.standalone(document.getElementById(saveDrawing)));
    if (savePicture) save(`${savePicture}.svg`, 'image/svg+xml', bytes(document.getElementById(savePicture).src));
    if (!saveTable) return;
    const rows = [...document.getElementById(saveTable).querySelectorAll('tr')];
    rigproof.saveCsv(saveTable, rows.map((row) => [...row.children].map((cell) => cell.textContent.trim())));
  });
})();
