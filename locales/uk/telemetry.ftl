# Що чути від апаратів: сповіщення й слова для того, про що вони доповідають.

heard-mode = режим { $mode }
heard-armed = двигуни активовано
heard-disarmed = двигуни деактивовано
heard-disarmed-idle = двигуни деактивовано: { $reason }
idle-no-takeoff = апарат не злетів за { $seconds } s
idle-on-ground = { $seconds } s на землі
carried-most = { $list ->
    [plan] план
    [fence] геозону
   *[rally] точки збору
} { $mark } (пунктів { $items }) мають: { $count } з { $all }
carried-most-none = не мають { $list ->
    [plan] плану
    [fence] геозони
   *[rally] точок збору
}: { $count } з { $all }
carried-differ = { $count ->
    [one] відрізняється
   *[other] відрізняються
} { $vehicles }: { $details }
carried-other = { $vehicles } — пунктів { $items } ({ $mark })
carried-none = { $vehicles } — нічого
carried-unread = ще не прочитано: { $vehicles }
carried-unsupported = такого списку немає: { $vehicles }

heard-event = подія { $id } ({ $level })
heard-events-lost = { $count ->
    [one] втрачено { $count } подію: апарат її вже не зберігає
    [few] втрачено { $count } події: апарат їх уже не зберігає
   *[other] втрачено { $count } подій: апарат їх уже не зберігає
}
event-emergency = аварія
event-alert = тривога
event-critical = критично
event-error = помилка
event-warning = попередження
event-notice = сповіщення
event-info = інформація
event-debug = налагодження
heard-plan-complete = план виконано до кінця
heard-plan-back = політ за планом повернувся з пункту { $before } до { $item }
heard-plan-skipped = політ за планом перейшов із пункту { $before } до { $item }; про виконання не повідомлено: { $items }
heard-plan-unknown = пункт { $item } пропущено: апарат не знає команди { $command } у плані
heard-plan-unknown-somewhere = пункт пропущено: апарат не знає команди { $command } у плані
heard-control-free = апаратом не керує жодна наземна станція
heard-control-ours = апаратом керує ця консоль
heard-control-theirs = керування перейняла наземна станція { $station }
heard-control-request = наземна станція { $station } просить керування: `{ $allow }` дозволяє перейняти його протягом 10 s, `{ $release }` звільняє апарат
heard-control-closed = перейняти керування без запиту вже не можна
heard-rebooted = автопілот перезапущено
heard-renumbered = тепер це апарат { $system }; `forget { $before }` прибирає старий номер
heard-link-lost = зв'язок втрачено
heard-link-back = зв'язок відновлено через { $seconds } s
heard-ekf-lost = EKF: позицію втрачено
heard-ekf-good = EKF: позиція є
heard-fix = GPS: фікс { $fix }
heard-fix-lost = GPS: фікс втрачено ({ $fix })
heard-fence = геозону порушено
heard-fence-low = геозону порушено (занизько)
heard-fence-high = геозону порушено (зависоко)
heard-fence-boundary = геозону порушено (межа)
heard-fence-back = знову в межах геозони
heard-two-vehicles = два апарати відповідають під номером системи { $system }: задайте одному інший SYSID_THISMAV
heard-board = { $place }, плата { $board }
heard-twice = апарат { $system } чути двічі: { $used } (використовується), { $ignored } (ігнорується). Це один апарат: закрийте один із каналів
heard-two-places = номер системи { $system } мають два відправники: { $used } (використовується), { $ignored } (ігнорується). Якщо це два апарати, під'єднайтеся лише до одного, задайте йому інший MAV_SYSID (до ArduPilot 4.6 — SYSID_THISMAV) і перезапустіть його
heard-flood = забагато текстів одразу: решту показує лише екран «повідомлення»
heard-from-peer = { $link } (від { $peer })
heard-by-another-link = тепер зв'язок через { $link }, а не через { $before }

fix-no-gps = без GPS
fix-none = немає
fix-float = плав.
fix-other = інший
