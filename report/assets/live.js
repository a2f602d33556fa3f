// Keeps the list of runs fresh without loading the page anew: what somebody chose in the form stays chosen, and the focus stays where it is.
(() => {
  const now = document.getElementById('now');
  const news = document.getElementById('news');
  const main = document.getElementById('content');
  let seen = now.dataset.revision;

  const local = (part) => part.querySelectorAll('time[data-ms]').forEach((own) => { own.textContent = new Date(Number(own.dataset.ms)).toLocaleString(); });
  const runs = () => [...main.querySelectorAll('#runs tbody th a')].map((own) => own.textContent);

  // The form keeps what was chosen, as long as that run is there.
  const choices = (own, fresh) => {
    for (const select of own.querySelectorAll('select')) {
      const chosen = select.value;
      select.replaceChildren(...fresh.querySelector(`#${select.id}`).children);
      if ([...select.options].some((option) => option.value === chosen)) select.value = chosen;
    }
  };
  const sections = (fresh) => {
    const wanted = [...fresh.querySelectorAll('main > section')];
    for (const own of main.querySelectorAll(':scope > section')) {
      if (!wanted.some((section) => section.id === own.id)) own.remove();
    }
    let last = main.querySelector('nav');
    for (const section of wanted) {
      let own = document.getElementById(section.id);
      if (own && own.id === 'compare') choices(own, section);
      else if (own) own.replaceWith(section);
      else last.after(section);
      last = document.getElementById(section.id);
    }
  };
  const renewed = async () => {
    const before = runs();
    const focus = document.activeElement?.closest('#runs a')?.getAttribute('href');
    const fresh = new DOMParser().parseFromString(await (await fetch('/')).text(), 'text/html');
    for (const part of ['.verdict h1', 'nav']) main.querySelector(part).replaceWith(fresh.querySelector(`main ${part}`));
    main.querySelector('.verdict').className = fresh.querySelector('.verdict').className;
    local(fresh);
    sections(fresh);
    if (focus) main.querySelector(`#runs a[href="${CSS.escape(focus)}"]`)?.focus();
    const came = runs().filter((name) => !before.includes(name));
    if (came.length > 0) news.textContent = `New: ${came.join(', ')}.`;
  };
  const look = async () => {
    let wait = 3000;
    try {
      const state = await (await fetch('/state.json')).json();
      if (state.revision !== seen) {
        await renewed();
        seen = state.revision;
      }
      now.textContent = state.now;
      if (state.is_busy) wait = 1000;
    } catch {
      now.textContent = 'rigproof serve does not answer any more: this is the list as it was.';
    }
    setTimeout(look, wait);
  };
  local(document);
  setTimeout(look, 1000);
})();
