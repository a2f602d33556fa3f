// Light and dark: as the system says, until the button is pressed. Paper is always light.
const rigproof = { redraw: [] };
(() => {
  const root = document.documentElement;
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const button = document.getElementById('theme');
  let chosen = null;
  const show = (theme) => {
    root.dataset.theme = theme;
    // The button says what it does.
    button.textContent = theme === 'dark' ? 'Light' : 'Dark';
    for (const redraw of rigproof.redraw) redraw();
  };
  const wanted = () => chosen ?? (dark.matches ? 'dark' : 'light');
  button.addEventListener('click', () => {
    chosen = wanted() === 'dark' ? 'light' : 'dark';
    show(chosen);
  });
  dark.addEventListener('change', () => show(wanted()));
  rigproof.printing = false;
  addEventListener('beforeprint', () => { rigproof.printing = true; show('light'); });
  addEventListener('afterprint', () => { rigproof.printing = false; show(wanted()); });
  show(wanted());
})();
rigproof.colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
