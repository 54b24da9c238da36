// Steering by hand: lever and rudder of a ship with an engine, by keys, sliders and touch.

const leverStep = 0.1; // change of the lever per key press [-]
const angleStep = 5; // change of the steering angle per key press [°]

/** Handles the controls of the helm. `order(ship, lever, angle [rad])` and `release(ship)` receive the commands. */
function makeHelm({ order, release }) {
  const helm = { ship: -1, isTaken: false };
  const [lever, rudder, take, select] = ["lever", "rudder", "take-helm", "helm-ship"].map(byId);

  function show() {
    byId("lever-words").textContent = `${Math.round(100 * lever.value)} %`;
    const angle = Number(rudder.value);
    const side = angle > 0 ? "port" : "starboard";
    byId("rudder-words").textContent = angle === 0 ? "midships" : `${Math.abs(angle)}° ${side}`;
    take.setAttribute("aria-pressed", String(helm.isTaken));
    take.textContent = helm.isTaken ? "Give back to pilot" : "Take the helm";
  }

  function give() {
    if (!helm.isTaken) helm.setTaken(true);
    order(helm.ship, Number(lever.value), (Number(rudder.value) * Math.PI) / 180);
    show();
  }

  helm.setTaken = (isTaken) => {
    if (helm.ship < 0 || helm.isTaken === isTaken) return;
    helm.isTaken = isTaken;
    if (isTaken) give();
    else release(helm.ship);
    show();
  };
  /** Lists the ships of a run that can be steered. */
  helm.show = (ships) => {
    const choices = ships.map((ship, k) => [ship, k]).filter(([{ canBeSteered }]) => canBeSteered);
    byId("helm").hidden = choices.length === 0;
    select.replaceChildren(...choices.map(([{ name }, k]) => make("option", { value: k }, name)));
    select.hidden = choices.length < 2;
    helm.ship = choices[0]?.[1] ?? -1;
    helm.isTaken = false;
    [lever.value, rudder.value] = [1, 0];
    show();
  };
  /** Shows the lever and rudder of the pilot as long as the pilot controls the ship. */
  helm.follow = (hull) => {
    if (helm.isTaken || !hull) return;
    lever.value = hull[6];
    rudder.value = Math.round((hull[7] * 180) / Math.PI);
    show();
  };
  watchHelm(helm, [lever, rudder], give);
  return helm;
}

/** Handles keys, sliders and buttons of a helm. `give` passes the values of the sliders on. */
function watchHelm(helm, [lever, rudder], give) {
  const nudge = (slider, by) => {
    slider.value = Number(slider.value) + by;
    give();
  };
  helm.keys = { ArrowUp: () => nudge(lever, leverStep), ArrowDown: () => nudge(lever, -leverStep),
    ArrowLeft: () => nudge(rudder, angleStep), ArrowRight: () => nudge(rudder, -angleStep),
    0: () => nudge(rudder, -Number(rudder.value)) };
  for (const slider of [lever, rudder]) slider.addEventListener("input", give);
  byId("take-helm").addEventListener("click", () => helm.setTaken(!helm.isTaken));
  byId("helm-ship").addEventListener("change", () => {
    helm.setTaken(false);
    helm.ship = Number(byId("helm-ship").value);
  });
}
