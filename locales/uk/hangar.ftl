# Ангар: процеси ArduPilot SITL.

hangar-unknown = екземпляра { $id } немає
hangar-taken = екземпляр { $id } уже працює: спершу зупиніть його або виберіть інший номер
hangar-full = уже працює екземплярів: { $limit }, більше не можна; зупиніть зайві або збільште межу
hangar-no-program = { $program } не знайдено: вкажіть його через `--arducopter` чи `SORTIE_ARDUCOPTER` або додайте до PATH
hangar-attached = до екземпляра { $id } вже під'єднано іншу програму: закрийте її або виберіть інший екземпляр
hangar-host = не вдається запустити екземпляр { $id }: { $what }: { $error }
hangar-closing = ангар закривається
hangar-cannot-open = не вдається відкрити ангар у { $folder }: { $error }

hangar-none = Цих апаратів не симулює жоден процес. `sortie fly --backend ardupilot` запускає ArduPilot SITL для кожного апарата; тоді тут видно ці процеси.
hangar-opening = ангар відкривається ...
hangar-ready = готово { $ready } з { $count }
hangar-host-title = машина
hangar-stage = етап
hangar-pid = pid
hangar-restarts = пусків
hangar-memory = пам'ять
hangar-processor = ядро
hangar-stage-queued = у черзі
hangar-stage-process = працює
hangar-stage-heartbeat = на зв'язку
hangar-stage-fetching = параметри { $received }/{ $count }
hangar-stage-parameters = чекає координат
hangar-stage-position = координати, перевірки
hangar-stage-ready = готово
hangar-stage-stopping = завершується
hangar-stage-crashed = АВАРІЯ
hangar-stage-ended = завершено
hangar-vehicle = апарат { $vehicle }
hangar-fault = АВАРІЯ: { $reason }
hangar-fault-what = { $restart } перезапускає апарат на майданчику. { $stop } зупиняє його процес остаточно.
hangar-no-output = у { $folder }; ще нічого не виведено
hangar-output = у { $folder }; останній вивід:
hangar-output-of = апарат { $vehicle }: вивід
hangar-key-output = вивід
hangar-key-restart = перезапуск
hangar-key-stop = зупинити
hangar-key-leave = вийти
hangar-all-ready = { $count ->
    [one] { $count } апарат готовий до активації двигунів
    [few] усі { $count } апарати готові до активації двигунів
   *[other] усі { $count } апаратів готові до активації двигунів
}
hangar-ready-again = знову готовий до активації двигунів
hangar-restarted = його процес перезапущено (перезапуск { $count })
hangar-crash = його процесу вже немає: { $reason }
hangar-crash-said = його процесу вже немає: { $reason }; останнє, що він повідомив: { $line }
hangar-crash-again = { $key }, потім { $again } перезапускає його (`hangar restart { $vehicle }`)
hangar-no-process = процесу апарата { $vehicle } немає
hangar-ask-armed = його двигуни активні: у польоті він упаде
hangar-ask-restart = ПЕРЕЗАПУСТИТИ апарат { $vehicle }
hangar-ask-stop = ЗУПИНИТИ процес апарата { $vehicle }
hangar-restarting = апарат { $vehicle } перезапускається
hangar-stopping = процес апарата { $vehicle } зупиняється
hangar-not-begun = завдання почнеться, коли всі апарати будуть готові: { $key } показує їхній стан
hangar-failed = не вдалося запустити апарати: { $reason }
hangar-plain-stages = запуск: { $stages }
hangar-plain-stage = { $vehicles } { $stage }
hangar-plain-given-up = апарати не запустилися: політ на цьому закінчено
hangar-plain-none = цих апаратів не симулює жоден процес
hangar-here = тут

# Ангари на інших машинах.

hangar-far = ангар { $hangar }: { $error }
hangar-far-unreachable = { $address } недосяжний ({ $error }): чи працює там `sortie hangar`? Якщо ангар на іншій машині, перешліть його порт: `ssh -L PORT:127.0.0.1:PORT HOST`
hangar-far-late = { $address } не відповів за { $seconds } s: перевірте ту машину й мережу
hangar-far-other = { $address } відповідає, але це не ангар sortie ({ $error }): перевірте адресу
hangar-far-token = { $address } потребує токена ({ $error }): скопіюйте сюди файл із токеном і вкажіть його через `--hangar-token FILE`
