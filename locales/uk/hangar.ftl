# Ангар: процеси ArduPilot SITL.

hangar-unknown = екземпляра { $id } немає
hangar-taken = екземпляр { $id } уже працює: спершу зупиніть його або виберіть інший номер
hangar-full = уже працює екземплярів: { $limit }, це межа: зупиніть зайві або збільште межу
hangar-no-program = { $program } не знайдено: назвіть його через --arducopter чи SORTIE_ARDUCOPTER або додайте до PATH
hangar-attached = до екземпляра { $id } вже під'єднано іншу програму
hangar-host = не вдається запустити екземпляр { $id }: { $what }: { $error }
hangar-closing = ангар закривається
hangar-cannot-open = не вдалося відкрити ангар у { $folder }: { $error }

hangar-none = Жодні процеси не симулюють цих апаратів. `sortie fly --backend ardupilot` запускає ArduPilot SITL для кожного апарата; тоді тут видно ці процеси.
hangar-opening = ангар відкривається ...
hangar-ready = готові { $ready } з { $count }
hangar-host-title = хост
hangar-stage = етап
hangar-pid = pid
hangar-restarts = запуск
hangar-memory = пам'ять
hangar-processor = ядро
hangar-stage-queued = у черзі
hangar-stage-process = працює
hangar-stage-heartbeat = на зв'язку
hangar-stage-fetching = параметри { $received }/{ $count }
hangar-stage-parameters = чекає координат
hangar-stage-position = координати, перевірки
hangar-stage-ready = готовий
hangar-stage-stopping = завершується
hangar-stage-crashed = АВАРІЯ
hangar-stage-ended = завершений
hangar-vehicle = апарат { $vehicle }
hangar-fault = АВАРІЯ: { $reason }
hangar-fault-what = { $restart } перезапускає його на майданчику. { $stop } зупиняє остаточно.
hangar-no-output = у { $folder }; ще нічого не виведено
hangar-output = у { $folder }; останнє виведене:
hangar-output-of = апарат { $vehicle }: виведене
hangar-key-output = виведене
hangar-key-restart = перезапуск
hangar-key-stop = зупинити
hangar-key-leave = вийти
hangar-all-ready = { $count ->
    [one] { $count } апарат готовий до зльоту
    [few] усі { $count } апарати готові до зльоту
   *[other] усі { $count } апаратів готові до зльоту
}
hangar-ready-again = знову готовий до активації двигунів
hangar-restarted = його процес перезапущено ({ $count })
hangar-crash = його процес аварійно завершився: { $reason }
hangar-crash-said = його процес аварійно завершився: { $reason }: { $line }
hangar-crash-again = { $key }, потім { $again } перезапускає його (`hangar restart { $vehicle }`)
hangar-no-process = процесу апарата { $vehicle } немає
hangar-ask-armed = його двигуни активні: у польоті він упаде
hangar-ask-restart = Перезапустити апарат { $vehicle }?
hangar-ask-stop = Зупинити процес апарата { $vehicle }?
hangar-restarting = апарат { $vehicle } перезапускається
hangar-stopping = процес апарата { $vehicle } зупиняється
hangar-not-begun = завдання почнеться, коли всі апарати будуть готові: { $key } показує їхній стан
hangar-failed = не вдалося запустити апарати: { $reason }
hangar-plain-stages = запуск: { $stages }
hangar-plain-stage = { $vehicles } { $stage }
hangar-plain-given-up = апарати не запустилися: політ на цьому закінчено
hangar-plain-none = жодні процеси не симулюють цих апаратів
hangar-here = тут

# Ангари, що є службами деінде.

hangar-far = ангар { $hangar }: { $error }
hangar-far-unreachable = { $address } недосяжний ({ $error }): чи працює там `sortie hangar`? З іншої машини: `ssh -L PORT:127.0.0.1:PORT HOST`
hangar-far-late = { $address } не відповів за { $seconds } s
hangar-far-other = { $address } відповідає, але це не ангар sortie ({ $error })
hangar-far-token = { $address } потребує свого токена ({ $error }): скопіюйте сюди його файл токена й назвіть його через --hangar-token FILE
